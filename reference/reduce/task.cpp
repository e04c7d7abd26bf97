#include "reference/reduce/task.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "core/deform/lattice.h"
#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/scene/amount.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/scene.h"
#include "reference/scene/sweep_poses.h"
#include "reference/text/file_text.h"
#include "reference/text/json_field.h"
#include "reference/text/lists.h"

namespace contactcheck::reduce {
namespace {

namespace fs = std::filesystem;

/// The first triangle with that corner.
std::optional<std::uint32_t> triangle_with(const TriangleMesh& mesh, std::size_t vertex) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      if (v == vertex) return t;
  return std::nullopt;
}

/// A body that a case names, in the recorded frame.
class CaseElement {
 public:
  CaseElement(const text::JsonField& field, const Recording& recording, std::size_t frame)
      : field_(field), body_(find_body(recording)) {
    field.only_keys({"body", "triangle", "vertices", "vertices_decimal", "cell", "nodes",
                     "nodes_decimal", "vertex", "position", "position_decimal"});
    shape_ = recording.bodies[body_].shape;
    nodes_ = recording.frames[frame][body_];
    vertices_.resize(shape_->mesh.vertices.size());
    map_body(*shape_, nodes_, vertices_);
  }

  std::size_t body() const { return body_; }

  /// The triangle that it names, or one of the vertex that it names.
  std::optional<std::uint32_t> triangle() const {
    if (field_.has("triangle")) return checked_triangle();
    if (!field_.has("vertex")) return std::nullopt;
    const text::JsonField number = field_.at("vertex");
    const auto vertex = shape_->given.vertex_of(
        static_cast<std::uint32_t>(number.whole(0, shape_->given_vertex_count() - 1)));
    if (!vertex) number.refuse("a vertex that a triangle uses");
    return triangle_with(shape_->mesh, *vertex);
  }

  std::optional<std::uint32_t> cell() const {
    if (!field_.has("cell")) return std::nullopt;
    if (!shape_->lattice) field_.at("cell").refuse("left out: the body has no lattice");
    const auto id =
        static_cast<std::uint32_t>(field_.at("cell").whole(0, shape_->lattice->cells.size() - 1));
    const Corners corners = corners_of(*shape_->lattice, id, nodes_);
    check_places("nodes", corners.data(), corners.size());
    return id;
  }

 private:
  std::size_t find_body(const Recording& recording) const {
    const std::string name = field_.at("body").text();
    std::vector<std::string> names;
    for (const Body& body : recording.bodies) names.push_back(body.name);
    return static_cast<std::size_t>(
        std::find(names.begin(), names.end(), field_.at("body").one_of(names)) - names.begin());
  }

  // Recordings are written anew by every run: that of another run would be reduced without a word.
  std::uint32_t checked_triangle() const {
    const std::vector<Triangle>& triangles = shape_->mesh.triangles;
    const std::size_t id = field_.at("triangle").whole(0, triangles.size() - 1);
    std::vector<Vec3> corners;
    for (const std::uint32_t v : triangles[id]) corners.push_back(vertices_[v]);
    check_places("vertices", corners.data(), corners.size());
    return static_cast<std::uint32_t>(id);
  }

  void check_places(const char* key, const Vec3* recorded, std::size_t count) const {
    if (!field_.has(key)) return;
    const text::JsonField list = field_.at(key);
    const std::vector<text::JsonField> places = list.items();
    if (places.size() != count) list.refuse("an array of " + std::to_string(count) + " places");
    for (std::size_t i = 0; i < count; ++i)
      if (scene::at(scene::parse_amount_vector(places[i]), 0.0) != recorded[i])
        places[i].fail("is not where the recording has it: it is the recording of another run");
  }

  text::JsonField field_;
  std::size_t body_;
  std::shared_ptr<const BodyShape> shape_;
  std::vector<Vec3> nodes_, vertices_;
};

// The body with the lower index comes first: a detector is given them in the order of the scene.
void take_bodies(const text::JsonField& root, const Recording& recording, ReductionTask& task) {
  CaseElement first(root.at("first"), recording, task.frame),
      second(root.at("second"), recording, task.frame);
  if ((first.body() == second.body()) != task.self)
    root.at("second").at("body").refuse(task.self ? "the body of first"
                                                  : "another body than first");
  if (first.body() > second.body()) std::swap(first, second);
  for (const std::size_t b : std::set{first.body(), second.body()}) {
    task.snapshot.bodies.push_back(recording.bodies[b]);
    task.snapshot.nodes.push_back(recording.frames[task.frame][b]);
  }
  task.frame_of_case = {recording.bodies, recording.frames[task.frame]};
  task.named = {first.body(), second.body()};
  const std::optional<std::uint32_t> a = first.triangle(), b = second.triangle();
  if (a && b) task.pair = TrianglePair{*a, *b};
  const std::optional<std::uint32_t> c = first.cell(), d = second.cell();
  if (c && d) task.cells = CellPair{*c, *d};
}

// A case without a recording: its two triangles are all there is.
void take_triangles(const text::JsonField& root, ReductionTask& task) {
  CaseCandidate pair;
  pair.names.resize(2);
  pair.meshes.resize(2);
  for (std::size_t side = 0; side < 2; ++side) {
    const text::JsonField element = root.at(side == 0 ? "first" : "second");
    pair.names[side] = element.at("body").text();
    const std::vector<text::JsonField> corners = element.at("vertices").items(3);
    if (corners.size() != 3) element.at("vertices").refuse("an array of 3 places");
    for (const text::JsonField& corner : corners)
      pair.meshes[side].vertices.push_back(scene::at(scene::parse_amount_vector(corner), 0.0));
    pair.meshes[side].triangles = {{0, 1, 2}};
  }
  if (pair.names[0] == pair.names[1])
    root.at("second").at("body").refuse("another body than first");
  task.snapshot = snapshot_of(pair);
  task.pair = TrianglePair{0, 0};
}

std::string frame_text(std::size_t frame) { return "frame " + std::to_string(frame); }

ReductionTask task_of_frame(const scene::Scene& scene, std::size_t frame) {
  ReductionTask task;
  task.scene = scene.id;
  task.frame = frame;
  task.place = scene.family()
                   ? "value " + scene.family()->values[frame] + " (" + frame_text(frame) + ")"
                   : frame_text(frame);
  task.snapshot = {scene.bodies, scene.nodes_of_frame(frame)};
  task.self = any_self(scene.levels);
  return task;
}

std::size_t frame_named(const scene::Scene& scene, const std::string& which) {
  if (scene.family()) {
    const std::vector<std::string>& values = scene.family()->values;
    const auto found = std::find(values.begin(), values.end(), which);
    if (found != values.end()) return static_cast<std::size_t>(found - values.begin());
    throw InputError("\"" + scene.id + "\" has no value \"" + which + "\"; it has " +
                     text::joined(values));
  }
  const bool number = !which.empty() && which.size() < 9 &&
                      which.find_first_not_of("0123456789") == std::string::npos;
  if (number && std::stoul(which) < scene.frames) return std::stoul(which);
  throw InputError("\"" + scene.id + "\" has no frame \"" + which + "\"; it has frames 0 to " +
                   std::to_string(scene.frames - 1));
}

Recording recording_of(const text::JsonField& root, const fs::path& file) {
  const fs::path recording_file = file.parent_path() / root.at("recording").text();
  std::error_code ignored;
  if (!fs::exists(recording_file, ignored))
    root.at("recording")
        .fail("names " + text::in_quotes(recording_file.string()) + ", which does not exist");
  Recording recording = read_recording(recording_file);
  if (recording.frames.empty()) root.at("recording").fail("names a recording without a frame");
  return recording;
}

}  // namespace

std::optional<TrianglePair> triangles_of(const judge::Disagreement& d, const Snapshot& snapshot) {
  const auto [first, second] = judge::elements_of(d.level, d.kind);
  if (first == Element::kTriangle) return TrianglePair{d.pair.a, d.pair.b};
  if (second != Element::kTriangle) return std::nullopt;
  const auto of_vertex = triangle_with(snapshot.bodies[d.pair.body_a].shape->mesh, d.pair.a);
  if (!of_vertex) return std::nullopt;
  return d.pair.body_a < d.pair.body_b ? TrianglePair{*of_vertex, d.pair.b}
                                       : TrianglePair{d.pair.b, *of_vertex};
}

std::optional<CellPair> cells_of(const judge::Disagreement& d) {
  if (judge::elements_of(d.level, d.kind).first != Element::kCell) return std::nullopt;
  return CellPair{d.pair.a, d.pair.b};
}

bool is_case_file(const fs::path& file) {
  std::error_code ignored;
  if (file.extension() != ".json" || !fs::exists(file, ignored)) return false;
  const std::string document = "case file " + text::in_quotes(file.string());
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, "case file"), document);
  return value.kind == text::JsonValue::Kind::kObject &&
         (value.find("detector") != nullptr || value.find("kind") != nullptr ||
          value.find("recording") != nullptr);
}

ReductionTask read_case(const fs::path& file) {
  const std::string document = "case file " + text::in_quotes(file.string());
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, "case file"), document);
  const text::JsonField root(value, document);
  root.only_keys({"scene", "frame", "detector", "level", "kind", "recording", "first", "second"});
  ReductionTask task;
  task.scene = root.at("scene").text();
  task.detector = root.at("detector").text();
  task.level = root.at("level").one_of(level_names());
  task.kind = root.at("kind").one_of({"missed", "spurious"});
  task.self = is_self(*level_from_name(task.level));
  if (task.self && !root.has("recording"))
    root.fail("has a contact of a body with itself and no recording, which tells neighbours");
  if (root.has("recording")) {
    const Recording recording = recording_of(root, file);
    task.frame = root.at("frame").whole(0, recording.frames.size() - 1);
    take_bodies(root, recording, task);
  } else {
    task.frame = root.at("frame").whole(0, std::numeric_limits<std::uint32_t>::max());
    take_triangles(root, task);
  }
  task.place = frame_text(task.frame);
  return task;
}

std::vector<ReductionTask> tasks_of_scene(const std::string& text, const fs::path& fixtures) {
  const std::size_t at = text.rfind('@');
  std::error_code ignored;
  // A file whose own name has an @ stays whole.
  const bool has_which = at != std::string::npos && !fs::exists(text, ignored);
  const std::string name = has_which ? text.substr(0, at) : text;
  const scene::Target target = scene::find_target(name, fixtures);
  if (target.kind == scene::TargetKind::kSuite)
    throw InputError("\"" + name +
                     "\" is a suite; reduce takes a case, a scene, a family "
                     "of hard cases or a recording");
  scene::Scene scene = scene::load_any_scene(target.file);
  if (scene.simulation())
    throw InputError("\"" + scene.id + "\" is simulated: run it, and reduce its recording");
  scene::place_sweep([](std::size_t) {}, scene);
  if (has_which) return {task_of_frame(scene, frame_named(scene, text.substr(at + 1)))};
  std::vector<ReductionTask> tasks;
  for (std::size_t f = 0; f < scene.frames; ++f) tasks.push_back(task_of_frame(scene, f));
  return tasks;
}

}  // namespace contactcheck::reduce
