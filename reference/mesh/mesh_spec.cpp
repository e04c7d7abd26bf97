#include "reference/mesh/mesh_spec.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "core/types/given_vertices.h"
#include "reference/mesh/datasets.h"
#include "reference/mesh/shapes.h"
#include "reference/mesh/tessellation.h"
#include "reference/text/file_text.h"

namespace contactcheck::mesh {
namespace {

// Sizes beyond these are typing errors sooner than scenes, and would drown in rounding.
constexpr double kLargestLength = 1e6;  // metres
constexpr double kLargestScale = 1e9;
constexpr std::size_t kMostTriangles = 10'000'000;
constexpr std::size_t kMostSubdivisions = 6;
constexpr text::NumberRange kLength = {0.0, true, kLargestLength, false};

struct ShapeRule {
  const char* name;
  std::vector<std::string> own_keys;  // besides "divisions"
  std::size_t fewest, most, usual;    // divisions
};

const std::vector<ShapeRule>& shape_rules() {
  static const std::vector<ShapeRule> rules = {
      {"box", {"sides"}, 1, 256, 1},     {"sphere", {}, 0, 7, 3},
      {"torus", {"tube"}, 3, 512, 16},   {"letter", {"letter", "depth"}, 1, 32, 4},
      {"sheet", {"length"}, 1, 512, 16}, {"teapot", {"seams"}, 1, 64, 10}};
  return rules;
}

// `keys`: what else the mesh may have.
void parse_shape(const text::JsonField& field, std::vector<std::string> keys, MeshSpec& spec) {
  std::vector<std::string> names;
  for (const ShapeRule& rule : shape_rules()) names.emplace_back(rule.name);
  spec.name = field.at("shape").one_of(names);
  const auto rule = std::find_if(shape_rules().begin(), shape_rules().end(),
                                 [&](const ShapeRule& r) { return spec.name == r.name; });
  CONTACTCHECK_INVARIANT(rule != shape_rules().end(), "one_of allows known shapes alone");
  keys.emplace_back("divisions");
  keys.insert(keys.end(), rule->own_keys.begin(), rule->own_keys.end());
  field.only_keys(keys);
  spec.divisions = rule->usual;
  if (field.has("divisions")) {
    spec.divisions = field.at("divisions").whole(rule->fewest, rule->most);
  }
  if (spec.name == "box") {
    const Vec3 sides = field.has("sides") ? field.at("sides").vector(kLength) : Vec3::Ones();
    spec.sides = {sides.x(), sides.y(), sides.z()};
  } else if (spec.name == "teapot") {
    spec.seams = field.has("seams") && field.at("seams").boolean();
  } else if (spec.name == "sheet") {
    spec.length = field.has("length") ? field.at("length").number(kLength) : 1.0;
  } else if (spec.name == "torus") {
    spec.tube = field.has("tube") ? field.at("tube").number({0.0, true, 1.0, true}) : 0.4;
  } else if (spec.name == "letter") {
    std::vector<std::string> letters;
    for (const char c : known_letters()) letters.emplace_back(1, c);
    spec.letter = field.at("letter").one_of(letters)[0];
    spec.depth = field.has("depth") ? field.at("depth").number({0.0, true, 4.0, false}) : 0.2;
  }
}

LoadedMesh load_source(const MeshSpec& spec) {
  switch (spec.source) {
    case MeshSpec::Source::kDataset:
      return load_dataset(spec.name);
    case MeshSpec::Source::kFile:
      return read_mesh_file(spec.name, spec.folded);
    case MeshSpec::Source::kShape:
      break;
  }
  if (spec.name == "box") return {make_box(Vec3(spec.sides.data()), spec.divisions), ""};
  if (spec.name == "sphere") return {make_sphere(spec.divisions), ""};
  if (spec.name == "sheet") return {make_sheet(spec.length, spec.divisions), ""};
  if (spec.name == "torus") return {make_torus(spec.tube, spec.divisions), ""};
  if (spec.name == "letter") return {make_letter(spec.letter, spec.depth, spec.divisions), ""};
  return {make_teapot(spec.divisions, data_roots(), spec.seams), ""};
}

// Vertices that no triangle uses keep their numbers; they count in no box and overflow nowhere.
void place(const MeshSpec& spec, const text::JsonField& field, TriangleMesh& mesh) {
  const GivenVertices given = drop_unused_vertices(mesh);
  const double side = bounding_box(mesh.vertices).extent().maxCoeff();
  if (spec.size && !(side > 0.0)) field.at("size").fail("cannot be reached: the mesh is a point");
  const double factor = spec.size ? *spec.size / side : spec.scale.value_or(1.0);
  if (spec.size || spec.scale) {
    for (Vec3& v : mesh.vertices) v *= factor;
  }
  if (spec.center) {
    const Vec3 shift = Vec3(spec.center->data()) - bounding_box(mesh.vertices).center();
    for (Vec3& v : mesh.vertices) v += shift;
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].allFinite()) continue;
    field.fail("makes vertex " + std::to_string(given.number_of(static_cast<std::uint32_t>(i))) +
               " overflow; coordinates must stay finite");
  }
  if (given.dropped > 0)
    mesh = {given.spread(mesh.vertices), given.numbered(std::move(mesh.triangles))};
}

}  // namespace

MeshSpec parse_mesh_spec(const text::JsonField& field, const std::filesystem::path& folder) {
  const std::string source = field.exactly_one_of({"dataset", "file", "shape"});
  std::vector<std::string> keys = {source,  "triangles", "subdivide", "size",
                                   "scale", "center",    "weld"};
  MeshSpec spec;
  if (source == "shape") {
    parse_shape(field, std::move(keys), spec);
  } else {
    if (source == "file") keys.emplace_back("repair");
    field.only_keys(keys);
    spec.source = source == "file" ? MeshSpec::Source::kFile : MeshSpec::Source::kDataset;
    spec.name = field.at(source).text();
    if (source == "file") spec.name = (folder / spec.name).lexically_normal().string();
  }
  if (field.has("triangles")) spec.triangles = field.at("triangles").whole(4, kMostTriangles);
  if (field.has("subdivide")) spec.subdivide = field.at("subdivide").whole(0, kMostSubdivisions);
  if (field.has("size") && field.has("scale")) {
    field.fail("has both \"size\" and \"scale\"; at most one of them is allowed");
  }
  if (field.has("size")) spec.size = field.at("size").number(kLength);
  if (field.has("scale")) spec.scale = field.at("scale").number({0.0, true, kLargestScale, false});
  if (field.has("center")) {
    const Vec3 c = field.at("center").vector({-kLargestLength, false, kLargestLength, false});
    spec.center = std::array<double, 3>{c.x(), c.y(), c.z()};
  }
  if (field.has("repair") && field.at("repair").boolean()) spec.folded = Folded::kFanned;
  spec.weld = field.has("weld") && field.at("weld").boolean();
  return spec;
}

LoadedMesh build_mesh(const MeshSpec& spec, const text::JsonField& field) {
  LoadedMesh loaded;
  try {
    loaded = load_source(spec);
  } catch (const InputError& error) {
    // The sentence goes on after the field that asked for the mesh.
    field.fail("cannot be loaded: " + text::without_full_stop(error.what()));
  }
  if (spec.triangles) {
    const std::size_t given = loaded.mesh.triangles.size(), wanted = *spec.triangles;
    if (wanted > given)
      field.at("triangles").refuse("at most " + std::to_string(given) + ", the mesh's own number");
    add_note_of_dropped(loaded.notes, drop_unused_vertices(loaded.mesh).dropped);
    loaded.mesh = simplify(loaded.mesh, wanted);
    const std::size_t reached = loaded.mesh.triangles.size();
    if (reached != wanted)
      add_note(loaded.notes, "simplified to " + std::to_string(reached) + " triangles, asked for " +
                                 std::to_string(wanted));
  }
  const std::size_t finer = loaded.mesh.triangles.size() << (2 * spec.subdivide);
  if (finer > kMostTriangles) {
    field.at("subdivide")
        .fail("makes " + std::to_string(finer) + " triangles; at most " +
              std::to_string(kMostTriangles) + " are allowed");
  }
  loaded.mesh = subdivide(std::move(loaded.mesh), spec.subdivide);
  place(spec, field, loaded.mesh);
  return loaded;
}

std::string described_source(const MeshSpec& spec) {
  std::string out;
  switch (spec.source) {
    case MeshSpec::Source::kDataset:
      out = "libcgal-demo:" + spec.name + ".off";
      break;
    case MeshSpec::Source::kFile:
      out = spec.name;
      break;
    case MeshSpec::Source::kShape:
      out = spec.name == "teapot" ? "povray-examples:teapot.inc" : spec.name;
      if (spec.letter != '\0') out += std::string(" ") + spec.letter;
      out += ", " + std::to_string(spec.divisions) + " divisions";
      break;
  }
  if (spec.triangles) out += ", simplified to " + std::to_string(*spec.triangles) + " triangles";
  if (spec.subdivide > 0) out += ", subdivided " + std::to_string(spec.subdivide) + " times";
  return out;
}

}  // namespace contactcheck::mesh
