// Fuzz target: scene files. The scene lies in a folder of its own, with one mesh beside it and no
// data packages; a scene that names a file elsewhere, or is too large to be built in a few
// milliseconds, is left alone.

#include <map>
#include <string>

#include "core/types/check.h"
#include "reference/scene/scene.h"
#include "reference/text/json_value.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

constexpr const char* kMesh =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

struct Surroundings {
  Scratch folder;
  Environment no_data{"CONTACTCHECK_DATA", folder.folder().string()};

  Surroundings() {
    for (const char* name : {"tetrahedron.off", "frame_1.off", "frame_2.off"})
      folder.write(name, kMesh);
  }
};

const Scratch& scratch() {
  static const Surroundings surroundings;
  return surroundings.folder;
}

// What the time to build a scene grows with: any number in the value of these keys.
bool small_number(const std::string& key, double value) {
  static const std::map<std::string, double> most = {
      {"divisions", 4}, {"subdivide", 1}, {"cells", 6}, {"kept", 60}, {"counts", 3}};
  const auto limit = most.find(key);
  return limit == most.end() || value <= limit->second;
}

bool own_file(const std::string& key, const std::string& text) {
  const bool path = key == "file" || key == "frames" || key == "cache";
  return !path || (text.find('/') == std::string::npos && text != "scene.json");
}

bool harmless(const text::JsonValue& value, const std::string& key = "") {
  if (value.kind == text::JsonValue::Kind::kNumber && !small_number(key, value.number))
    return false;
  if (value.kind == text::JsonValue::Kind::kText && !own_file(key, value.text)) return false;
  const bool object = value.kind == text::JsonValue::Kind::kObject;
  for (std::size_t i = 0; i < value.items.size(); ++i)
    if (!harmless(value.items[i], object ? value.keys[i] : key)) return false;
  return true;
}

// Text that is no JSON is harmless: nothing is built of it.
bool harmless_text(const std::string& text) {
  try {
    return harmless(text::parse_json(text, "scene file"));
  } catch (const InputError&) {
    return true;
  }
}

void check_nodes(const scene::Scene& scene, const std::vector<std::vector<Vec3>>& nodes) {
  require(nodes.size() == scene.bodies.size(), "there are nodes for every body");
  for (std::size_t b = 0; b < nodes.size(); ++b)
    require(nodes[b].size() == scene.bodies[b].shape->node_count(), "every node has a position");
}

void check_nodes(const scene::Scene& scene, double time) {
  check_nodes(scene, scene.nodes_at(time));
}

void check_recorded(const scene::Scene& scene) {
  require(scene.recorded.size() == scene.frames, "every frame is recorded");
  for (const auto& nodes : scene.recorded) check_nodes(scene, nodes);
  for (const scene::FitError& fit : scene.fits)
    require(fit.rms.size() == scene.frames && fit.max.size() == scene.frames,
            "a fit has an error for every frame");
}

void check_promises(const scene::Scene& scene) {
  require(scene.frames > 0 && scene.time_step > 0.0, "a scene has frames and a time step");
  require(!scene.bodies.empty() && !scene.levels.empty(), "a scene has bodies and levels");
  require(scene.origins.size() == scene.bodies.size(), "every body has an origin");
  require(scene.motions.size() == scene.bodies.size(), "every body has a motion");
  for (const Body& body : scene.bodies)
    require(!body.shape->topology.fatal, "no body has a fatal defect");
  if (!scene.recorded.empty()) return check_recorded(scene);
  check_nodes(scene, 0.0);
  if (!scene.scripted()) return;
  check_nodes(scene, scene.time_of(scene.frames / 2));
  check_nodes(scene, scene.time_of(scene.frames - 1));
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(scene) {
  using namespace contactcheck;
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (!test::harmless_text(text)) return test::kNotForTheCorpus;
  try {
    test::check_promises(scene::load_scene(test::scratch().write("scene.json", text)));
  } catch (const InputError& refusal) {
    test::require_sentence(refusal.what(), test::scratch().folder());
  }
  return 0;
}
