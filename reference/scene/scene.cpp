#include "reference/scene/scene.h"

#include <algorithm>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "core/types/mesh_topology.h"
#include "reference/mesh/mesh_file.h"
#include "reference/scene/common_fields.h"
#include "reference/scene/drawn_scene.h"
#include "reference/scene/motion_spec.h"
#include "reference/scene/random_pairs.h"
#include "reference/text/file_text.h"

namespace contactcheck::scene {
namespace {

std::vector<Vec3> rest_nodes(const BodyShape& shape) {
  return shape.lattice ? shape.lattice->rest_nodes() : shape.mesh.vertices;
}

}  // namespace

bool Scene::judges(Level level) const {
  return std::find(levels.begin(), levels.end(), level) != levels.end();
}

std::vector<std::vector<Vec3>> Scene::nodes_at(double time) const {
  CONTACTCHECK_INVARIANT(
      scripted() || ((simulation() != nullptr || sweep() != nullptr) && time == 0.0),
      "a recording has frames, a simulation a start: neither has times");
  std::vector<std::vector<Vec3>> nodes;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyShape& shape = *bodies[b].shape;
    // A resting body keeps the bits of its mesh: moving there and back would round.
    nodes.push_back(is_rest(motions[b]) ? rest_nodes(shape)
                                        : contactcheck::nodes_at(shape, motions[b], time));
  }
  return nodes;
}

std::vector<std::vector<Vec3>> Scene::nodes_of_frame(std::size_t frame) const {
  CONTACTCHECK_INVARIANT(frame < frames, "the scene has this frame");
  if (scripted()) return nodes_at(time_of(frame));
  if (pairs() != nullptr) return pairs()->nodes(frame);
  if (read_frame) return read_frame(frame);
  CONTACTCHECK_INVARIANT(frame < recorded.size(), "a simulated scene has been run, a sweep placed");
  return recorded[frame];
}

double Scene::size() const {
  double largest = 0.0;
  for (const Body& body : bodies) {
    largest = std::max(largest, bounding_box(body.shape->mesh.vertices).extent().maxCoeff());
  }
  return largest;
}

Scene make_pairs_scene(const PairSpec& spec) {
  Scene scene;
  scene.id = kPairsSceneId;
  scene.title = "Random hard pairs of triangles: touching, or apart by rounding";
  scene.kind = std::make_shared<RandomPairs>(spec);
  scene.frames = scene.pairs()->frames();
  scene.time_step = 1.0;
  scene.levels = {Level::kBody, Level::kCell, Level::kTriangle};
  for (const char* name : {"a", "b"}) {
    scene.bodies.push_back({name, scene.pairs()->shape()});
    scene.origins.push_back(
        {name, "made from the seed", describe(scene.pairs()->shape()->topology)});
  }
  return scene;
}

Scene load_recording(const std::filesystem::path& file) {
  Recording recording = read_recording(file);
  if (recording.frames.empty()) {
    throw InputError("recording " + text::in_quotes(file.string()) + " holds no frame.");
  }
  Scene scene;
  scene.id = recording.scene;
  scene.title = "Recording of " + recording.scene;
  scene.bodies = std::move(recording.bodies);
  scene.frames = recording.frames.size();
  scene.time_step = recording.time_step;
  scene.levels = {Level::kBody, Level::kCell, Level::kBox, Level::kTriangle, Level::kNear};
  if (!recording.levels.empty()) scene.levels = recording.levels;
  scene.recorded = std::move(recording.frames);
  for (const Body& body : scene.bodies) {
    scene.origins.push_back({body.name, "recording", shape_notes(*body.shape)});
  }
  return scene;
}

void weld(Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    std::shared_ptr<const BodyShape>& shape = scene.bodies[b].shape;
    std::string& notes = scene.origins[b].notes;
    // Whoever loads a mesh notes its defects last.
    const std::string defects = describe(shape->topology);
    if (notes.ends_with(defects)) notes.erase(notes.size() - defects.size());
    if (notes.ends_with("; ")) notes.erase(notes.size() - 2);
    shape = welded(*shape);
    mesh::add_note(notes, describe(shape->topology));
  }
}

void refuse_crowded_vertices(const Scene& scene) {
  if (!any_self(scene.levels)) return;
  for (const Body& body : scene.bodies) {
    try {
      refuse_many_adjacent_pairs(body.shape->linked());
    } catch (const RefusedInput& e) {
      throw InputError("self-contact of body " + text::in_quotes(body.name) + ": " + e.what());
    }
  }
}

namespace {

Scene load_source(const SceneSource& source, std::size_t frames) {
  if (const auto* pairs = std::get_if<PairSpec>(&source)) return make_pairs_scene(*pairs);
  if (const auto* text = std::get_if<SceneText>(&source)) return load_scene_text(*text, frames);
  if (const auto* drawn = std::get_if<DrawnSpec>(&source)) return draw_scene(*drawn).scene;
  const auto& file = std::get<std::filesystem::path>(source);
  if (file.extension() != ".ccr") return load_scene(file, frames);
  Scene scene = load_recording(file);
  if (frames > scene.frames)
    throw InputError("--frames: recording \"" + file.string() + "\" has " +
                     std::to_string(scene.frames) + " frames");
  if (frames > 0) {
    scene.recorded.resize(frames);
    scene.frames = frames;
  }
  return scene;
}

}  // namespace

Scene load_any_scene(const SceneSource& source, std::size_t frames) {
  Scene scene = load_source(source, frames);
  refuse_crowded_vertices(scene);
  return scene;
}

SceneSource absolute(SceneSource source) {
  if (auto* file = std::get_if<std::filesystem::path>(&source))
    *file = std::filesystem::absolute(*file);
  if (auto* text = std::get_if<SceneText>(&source))
    text->folder = std::filesystem::absolute(text->folder);
  if (auto* drawn = std::get_if<DrawnSpec>(&source))
    for (std::filesystem::path& mesh : drawn->meshes) mesh = std::filesystem::absolute(mesh);
  return source;
}

}  // namespace contactcheck::scene
