#include "reference/scene/family_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/lattice.h"
#include "core/deform/node_shape.h"
#include "core/types/check.h"
#include "reference/mesh/mesh_spec.h"
#include "reference/scene/amount.h"
#include "reference/scene/common_fields.h"
#include "reference/scene/lattice_spec.h"
#include "reference/text/file_text.h"
#include "reference/text/id_check.h"

namespace contactcheck::scene {
namespace {

// How a case of a family moves a body's positions: lattice nodes, or vertices without a lattice.
// Sums, products and quotients of doubles alone: the same bits on every machine.

struct FamilyStep {
  enum class Kind {
    kScale,      ///< by `vector`, per axis, about the origin
    kTranslate,  ///< by `vector`
    kRotate,     ///< by `quaternion` over its squared length: a rotation without angles
    kRound,      ///< to the nearest multiple of `amount`
    kMoveNode,   ///< the lattice's node `node` by `vector`
    kMoveVertex  ///< the mesh's vertex `vertex` by `vector`; no lattice, or one of nodes
  };
  Kind kind = Kind::kScale;
  AmountVector vector = {};
  std::array<Amount, 4> quaternion = {};  ///< w, x, y, z
  Amount amount;
  GridIndex node = {};
  std::size_t vertex = 0;
};

constexpr std::size_t kMostNodesPerAxis = 129, kLargestVertex = 10'000'000;

// Rows of the rotation matrix of a quaternion, times its squared length.
std::array<Vec3, 3> rotation_rows(double w, double x, double y, double z) {
  const double xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  return {Vec3(ww + xx - yy - zz, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
          Vec3(2.0 * (x * y + w * z), ww - xx + yy - zz, 2.0 * (y * z - w * x)),
          Vec3(2.0 * (x * z - w * y), 2.0 * (y * z + w * x), ww - xx - yy + zz)};
}

double sum_of_products(const Vec3& a, const Vec3& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

// @throws InputError
FamilyStep parse_family_step(const text::JsonField& field) {
  const auto parts_of = [](const text::JsonField& list, std::size_t count, const char* allowed) {
    if (!list.is(text::JsonValue::Kind::kArray) || list.value().items.size() != count)
      list.refuse(allowed);
    return list.items();
  };
  FamilyStep step;
  const std::string kind =
      field.exactly_one_of({"scale", "translate", "rotate", "round", "node", "vertex"});
  const bool moves_one = kind == "node" || kind == "vertex";
  if (moves_one) {
    field.only_keys({kind, "by"});
  } else {
    field.only_keys({kind});
  }
  const text::JsonField value = field.at(kind);
  if (kind == "node") {
    step.kind = FamilyStep::Kind::kMoveNode;
    const std::vector<text::JsonField> parts =
        parts_of(value, 3, "an array of three whole numbers");
    for (std::size_t k = 0; k < 3; ++k)
      step.node[k] = static_cast<std::uint32_t>(parts[k].whole(0, kMostNodesPerAxis - 1));
  } else if (kind == "vertex") {
    step.kind = FamilyStep::Kind::kMoveVertex;
    step.vertex = value.whole(0, kLargestVertex);
  } else if (kind == "scale") {
    if (value.is(text::JsonValue::Kind::kArray)) {
      step.vector = parse_amount_vector(value);
    } else {
      step.vector.fill(parse_amount(value));
    }
  } else if (kind == "translate") {
    step.kind = FamilyStep::Kind::kTranslate;
    step.vector = parse_amount_vector(value);
  } else if (kind == "rotate") {
    step.kind = FamilyStep::Kind::kRotate;
    const std::vector<text::JsonField> parts =
        parts_of(value, 4, "an array of four amounts: w, x, y, z");
    for (std::size_t k = 0; k < 4; ++k) step.quaternion[k] = parse_amount(parts[k]);
  } else {
    step.kind = FamilyStep::Kind::kRound;
    step.amount = parse_amount(value);
  }
  if (moves_one) step.vector = parse_amount_vector(field.at("by"));
  return step;
}

// `lattice`: whose nodes the positions are; null for vertices. @pre the node or vertex exists
void apply(const FamilyStep& step, double parameter, const Lattice* lattice,
           std::span<Vec3> positions) {
  const Vec3 vector = at(step.vector, parameter);
  switch (step.kind) {
    case FamilyStep::Kind::kScale:
      for (Vec3& p : positions) p = p.cwiseProduct(vector);
      return;
    case FamilyStep::Kind::kTranslate:
      for (Vec3& p : positions) p += vector;
      return;
    case FamilyStep::Kind::kRotate: {
      std::array<double, 4> q;
      for (std::size_t i = 0; i < 4; ++i) q[i] = step.quaternion[i].at(parameter);
      const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
      const std::array<Vec3, 3> rows = rotation_rows(q[0], q[1], q[2], q[3]);
      for (Vec3& p : positions)
        p = Vec3(sum_of_products(rows[0], p), sum_of_products(rows[1], p),
                 sum_of_products(rows[2], p)) /
            square;
      return;
    }
    case FamilyStep::Kind::kRound: {
      const double unit = step.amount.at(parameter);
      for (Vec3& p : positions)
        for (int k = 0; k < 3; ++k) p[k] = std::nearbyint(p[k] / unit) * unit;
      return;
    }
    case FamilyStep::Kind::kMoveNode: {
      CONTACTCHECK_INVARIANT(lattice != nullptr, "nodes are moved in a lattice");
      const auto node = std::find(lattice->nodes.begin(), lattice->nodes.end(), step.node);
      CONTACTCHECK_INVARIANT(node != lattice->nodes.end(), "the node was looked up before");
      positions[static_cast<std::size_t>(node - lattice->nodes.begin())] += vector;
      return;
    }
    case FamilyStep::Kind::kMoveVertex:
      positions[step.vertex] += vector;
  }
}

constexpr std::size_t kMostFamilyVertices = 100'000;

// Where a body's vertices stand before the steps.
struct BaseMesh {
  std::vector<AmountVector> given;  // per vertex, of a mesh that the file spells out
  TriangleMesh built;               // else
  std::vector<Triangle> triangles;
  bool weld = false;
  std::string source, notes;

  std::vector<Vec3> vertices(double parameter) const {
    std::vector<Vec3> out = built.vertices;
    for (const AmountVector& v : given) out.push_back(at(v, parameter));
    return out;
  }
};

std::vector<Triangle> parse_triangles(const text::JsonField& field, std::size_t vertices) {
  std::vector<Triangle> out;
  for (const text::JsonField& item : field.items(1)) {
    const std::vector<text::JsonField> corners = item.items();
    if (corners.size() != 3) item.refuse("an array of three indices");
    Triangle t;
    for (std::size_t c = 0; c < 3; ++c)
      t[c] = static_cast<std::uint32_t>(corners[c].whole(0, vertices - 1));
    out.push_back(t);
  }
  return out;
}

BaseMesh parse_base_mesh(const text::JsonField& field, const std::filesystem::path& folder) {
  BaseMesh base;
  if (field.has("vertices")) {
    field.only_keys({"vertices", "triangles", "weld"});
    base.weld = field.has("weld") && field.at("weld").boolean();
    for (const text::JsonField& v : field.at("vertices").items(1))
      base.given.push_back(parse_amount_vector(v));
    base.triangles = parse_triangles(field.at("triangles"), base.given.size());
    base.source = "vertices given";
    return base;
  }
  const mesh::MeshSpec spec = mesh::parse_mesh_spec(field, folder);
  mesh::LoadedMesh loaded = mesh::build_mesh(spec, field);
  if (loaded.mesh.vertices.size() > kMostFamilyVertices)
    field.fail("has " + std::to_string(loaded.mesh.vertices.size()) +
               " vertices; a family may have " + std::to_string(kMostFamilyVertices));
  base.weld = spec.weld;
  base.triangles = loaded.mesh.triangles;
  base.built = std::move(loaded.mesh);
  base.source = mesh::described_source(spec);
  base.notes = loaded.notes;
  return base;
}

// A body of a family: the steps move its vertices where they are nodes or there is no lattice, else
// the lattice's nodes.
class FamilyBody {
 public:
  FamilyBody(const text::JsonField& field, const std::filesystem::path& folder, double first_value)
      : field_(field), base_(parse_base_mesh(field.at("mesh"), folder)) {
    if (field.has("steps"))
      for (const text::JsonField& step : field.at("steps").items()) {
        steps_.push_back(parse_family_step(step));
      }
    try {
      build(first_value);
      if (base_.weld) shape_ = welded(*shape_);
    } catch (const InputError& error) {
      field.at("mesh").fail("cannot be used: " + text::without_full_stop(error.what()));
    }
    check_steps();
  }

  const std::shared_ptr<const BodyShape>& shape() const { return shape_; }
  const BaseMesh& base() const { return base_; }
  // On nodes, a vertex that no triangle uses still moves one.
  std::string notes() const {
    std::string out = base_.notes;
    if (!on_nodes_.shape) mesh::add_note_of_dropped(out, shape_->given.dropped);
    return out;
  }

  std::vector<Vec3> nodes(double parameter) const {
    std::vector<Vec3> positions =
        moves_nodes() ? shape_->lattice->rest_nodes() : base_.vertices(parameter);
    for (const FamilyStep& step : steps_)
      apply(step, parameter, moves_nodes() ? &*shape_->lattice : nullptr, positions);
    if (on_nodes_.shape) return on_nodes_.nodes_for(positions);
    return moves_nodes() ? positions : shape_->given.kept(std::move(positions));
  }

 private:
  bool moves_nodes() const { return shape_->lattice && !on_nodes_.shape; }

  void build(double first_value) {
    if (!field_.has("lattice")) {
      shape_ = make_bare_shape({base_.vertices(first_value), base_.triangles});
      return;
    }
    const text::JsonField lattice = field_.at("lattice");
    if (lattice.is(text::JsonValue::Kind::kText)) {
      lattice.one_of({"nodes"});
      on_nodes_ = make_node_shape(base_.vertices(first_value).size(), base_.triangles);
      shape_ = on_nodes_.shape;
    } else {
      const LatticeSpec spec = parse_lattice_spec(lattice);
      shape_ = build_shape({base_.vertices(first_value), base_.triangles}, spec);
    }
  }

  void check_steps() const {
    const std::vector<text::JsonField> fields =
        steps_.empty() ? std::vector<text::JsonField>() : field_.at("steps").items();
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (steps_[i].kind == FamilyStep::Kind::kMoveNode && !has_node(steps_[i].node))
        fields[i].at("node").refuse("a node of a kept cell of this body's lattice");
      if (steps_[i].kind == FamilyStep::Kind::kMoveVertex &&
          (moves_nodes() || steps_[i].vertex >= shape_->given_vertex_count()))
        fields[i].at("vertex").refuse("a vertex of a body without a lattice or on its nodes");
    }
  }

  bool has_node(const GridIndex& node) const {
    if (!moves_nodes()) return false;
    const std::vector<GridIndex>& nodes = shape_->lattice->nodes;
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  }

  text::JsonField field_;
  BaseMesh base_;
  std::vector<FamilyStep> steps_;
  std::shared_ptr<const BodyShape> shape_;
  NodeShape on_nodes_;  // with "lattice": "nodes"
};

CaseFamily parse_parameter(const text::JsonField& root, std::vector<double>& values) {
  CaseFamily family;
  family.origin = root.at("origin").text();
  family.stresses = root.at("stresses").text();
  if (root.has("range")) family.range = root.at("range").one_of({"size", "distance"});
  const text::JsonField parameter = root.at("parameter");
  parameter.only_keys({"name", "values"});
  family.parameter = parameter.at("name").text();
  std::set<double> seen;
  for (const text::JsonField& item : parameter.at("values").items(1)) {
    const std::optional<double> value =
        item.is(text::JsonValue::Kind::kText) ? parse_double(item.value().text) : std::nullopt;
    if (!value || !seen.insert(*value).second)
      item.refuse("a text with one finite number, different from the others");
    if (!family.range.empty() && *value <= 0.0)
      item.refuse("a number above 0, as the family has a \"range\"");
    values.push_back(*value);
    family.values.push_back(item.value().text);
  }
  return family;
}

}  // namespace

Scene parse_family(const text::JsonField& root, const std::filesystem::path& folder) {
  root.only_keys({"id", "title", "origin", "stresses", "range", "parameter", "levels", "bodies"});
  Scene scene;
  scene.id = text::parse_id(root.at("id"));
  scene.title = root.at("title").text();
  std::vector<double> values;
  scene.kind = parse_parameter(root, values);
  scene.frames = values.size();
  scene.time_step = 1.0;
  scene.levels = {Level::kBody, Level::kContainment, Level::kCell, Level::kTriangle, Level::kNear};
  if (root.has("levels")) scene.levels = parse_levels(root.at("levels"));
  scene.recorded.resize(values.size());
  for (const text::JsonField& field : root.at("bodies").items(1)) {
    field.only_keys({"name", "mesh", "lattice", "steps"});
    const std::string name = parse_body_name(field.at("name"), scene.bodies);
    const FamilyBody body(field, folder, values[0]);
    scene.bodies.push_back({name, body.shape()});
    scene.origins.push_back({name, body.base().source, body.notes()});
    for (std::size_t f = 0; f < values.size(); ++f) {
      scene.recorded[f].push_back(body.nodes(values[f]));
      for (const Vec3& n : scene.recorded[f].back())
        if (!n.allFinite())
          field.fail("has a position that is not finite at the value " + scene.family()->values[f]);
    }
  }
  return scene;
}

}  // namespace contactcheck::scene
