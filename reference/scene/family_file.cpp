#include "reference/scene/family_file.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "core/deform/node_shape.h"
#include "core/types/check.h"
#include "reference/scene/amount.h"
#include "reference/scene/common_fields.h"
#include "reference/scene/family_step.h"
#include "reference/scene/file_text.h"
#include "reference/scene/id_check.h"
#include "reference/scene/lattice_spec.h"
#include "reference/scene/mesh_spec.h"

namespace contactcheck {
namespace {

constexpr std::size_t kMostFamilyVertices = 100'000;

// Where a body's vertices stand before the steps.
struct BaseMesh {
  std::vector<AmountVector> given;  // per vertex, of a mesh that the file spells out
  TriangleMesh built;               // else
  std::vector<Triangle> triangles;
  std::string source, notes;

  std::vector<Vec3> vertices(double parameter) const {
    std::vector<Vec3> out = built.vertices;
    for (const AmountVector& v : given) out.push_back(at(v, parameter));
    return out;
  }
};

std::vector<Triangle> parse_triangles(const JsonField& field, std::size_t vertices) {
  std::vector<Triangle> out;
  for (const JsonField& item : field.items(1)) {
    const std::vector<JsonField> corners = item.items();
    if (corners.size() != 3) item.refuse("an array of three indices");
    Triangle t;
    for (std::size_t c = 0; c < 3; ++c)
      t[c] = static_cast<std::uint32_t>(corners[c].whole(0, vertices - 1));
    out.push_back(t);
  }
  return out;
}

BaseMesh parse_base_mesh(const JsonField& field, const std::filesystem::path& folder) {
  BaseMesh base;
  if (field.has("vertices")) {
    field.only_keys({"vertices", "triangles"});
    for (const JsonField& v : field.at("vertices").items(1))
      base.given.push_back(parse_amount_vector(v));
    base.triangles = parse_triangles(field.at("triangles"), base.given.size());
    base.source = "vertices given";
    return base;
  }
  const MeshSpec spec = parse_mesh_spec(field, folder);
  LoadedMesh loaded = build_mesh(spec, field);
  if (loaded.mesh.vertices.size() > kMostFamilyVertices)
    field.fail("has " + std::to_string(loaded.mesh.vertices.size()) +
               " vertices; a family may have " + std::to_string(kMostFamilyVertices));
  base.triangles = loaded.mesh.triangles;
  base.built = std::move(loaded.mesh);
  base.source = described_source(spec);
  base.notes = loaded.notes;
  return base;
}

// A body of a family: the steps move its vertices where they are nodes or there is no lattice, else
// the lattice's nodes.
class FamilyBody {
 public:
  FamilyBody(const JsonField& field, const std::filesystem::path& folder, double first_value)
      : field_(field), base_(parse_base_mesh(field.at("mesh"), folder)) {
    if (field.has("steps"))
      for (const JsonField& step : field.at("steps").items()) {
        steps_.push_back(parse_family_step(step));
      }
    try {
      build(first_value);
    } catch (const InputError& error) {
      field.at("mesh").fail("cannot be used: " + without_full_stop(error.what()));
    }
    check_steps();
  }

  const std::shared_ptr<const BodyShape>& shape() const { return shape_; }
  const BaseMesh& base() const { return base_; }

  std::vector<Vec3> nodes(double parameter) const {
    std::vector<Vec3> positions =
        moves_nodes() ? shape_->lattice->rest_nodes() : base_.vertices(parameter);
    for (const FamilyStep& step : steps_)
      apply(step, parameter, moves_nodes() ? &*shape_->lattice : nullptr, positions);
    return on_nodes_.shape ? on_nodes_.nodes_for(positions) : positions;
  }

 private:
  bool moves_nodes() const { return shape_->lattice && !on_nodes_.shape; }

  void build(double first_value) {
    if (!field_.has("lattice")) {
      shape_ = make_bare_shape({base_.vertices(first_value), base_.triangles});
      return;
    }
    const JsonField lattice = field_.at("lattice");
    if (lattice.is(JsonValue::Kind::kText)) {
      lattice.one_of({"nodes"});
      on_nodes_ = make_node_shape(base_.vertices(first_value).size(), base_.triangles);
      shape_ = on_nodes_.shape;
    } else {
      const LatticeSpec spec = parse_lattice_spec(lattice);
      shape_ = build_shape({base_.vertices(first_value), base_.triangles}, spec);
    }
  }

  void check_steps() const {
    const std::vector<JsonField> fields =
        steps_.empty() ? std::vector<JsonField>() : field_.at("steps").items();
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (steps_[i].kind == FamilyStep::Kind::kMoveNode && !has_node(steps_[i].node))
        fields[i].at("node").refuse("a node of a kept cell of this body's lattice");
      if (steps_[i].kind == FamilyStep::Kind::kMoveVertex &&
          (moves_nodes() || steps_[i].vertex >= shape_->mesh.vertices.size()))
        fields[i].at("vertex").refuse("a vertex of a body without a lattice or on its nodes");
    }
  }

  bool has_node(const GridIndex& node) const {
    if (!moves_nodes()) return false;
    const std::vector<GridIndex>& nodes = shape_->lattice->nodes;
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  }

  JsonField field_;
  BaseMesh base_;
  std::vector<FamilyStep> steps_;
  std::shared_ptr<const BodyShape> shape_;
  NodeShape on_nodes_;  // with "lattice": "nodes"
};

CaseFamily parse_parameter(const JsonField& root, std::vector<double>& values) {
  CaseFamily family;
  family.origin = root.at("origin").text();
  family.stresses = root.at("stresses").text();
  const JsonField parameter = root.at("parameter");
  parameter.only_keys({"name", "values"});
  family.parameter = parameter.at("name").text();
  std::set<double> seen;
  for (const JsonField& item : parameter.at("values").items(1)) {
    const std::optional<double> value =
        item.is(JsonValue::Kind::kText) ? parse_double(item.value().text) : std::nullopt;
    if (!value || !seen.insert(*value).second)
      item.refuse("a text with one finite number, different from the others");
    values.push_back(*value);
    family.values.push_back(item.value().text);
  }
  return family;
}

void require_finite(const std::vector<Vec3>& nodes, const JsonField& body,
                    const std::string& value) {
  for (const Vec3& n : nodes)
    if (!n.allFinite()) body.fail("has a position that is not finite at the value " + value);
}

void add_body(const JsonField& field, const std::filesystem::path& folder,
              const std::vector<double>& values, Scene& scene) {
  field.only_keys({"name", "mesh", "lattice", "steps"});
  const std::string name = parse_body_name(field.at("name"), scene.bodies);
  const FamilyBody body(field, folder, values[0]);
  scene.bodies.push_back({name, body.shape()});
  scene.origins.push_back({name, body.base().source, body.base().notes});
  for (std::size_t f = 0; f < values.size(); ++f) {
    scene.recorded[f].push_back(body.nodes(values[f]));
    require_finite(scene.recorded[f].back(), field, scene.family->values[f]);
  }
}

}  // namespace

Scene parse_family(const JsonField& root, const std::filesystem::path& folder) {
  root.only_keys({"id", "title", "origin", "stresses", "parameter", "levels", "bodies"});
  Scene scene;
  scene.id = parse_id(root.at("id"));
  scene.title = root.at("title").text();
  std::vector<double> values;
  scene.family = parse_parameter(root, values);
  scene.frames = values.size();
  scene.time_step = 1.0;
  scene.levels = {Level::kBody, Level::kContainment, Level::kCell, Level::kTriangle, Level::kNear};
  if (root.has("levels")) scene.levels = parse_levels(root.at("levels"));
  scene.recorded.resize(values.size());
  for (const JsonField& body : root.at("bodies").items(1)) {
    add_body(body, folder, values, scene);
  }
  return scene;
}

}  // namespace contactcheck
