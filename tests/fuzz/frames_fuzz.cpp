// Fuzz target: numbered OBJ or PLY files, one after the other with a line "next frame" between
// them, as the recorded deformation of a scene's body. A body without a lattice is in every frame
// where its file has it.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/check.h"
#include "reference/mesh/mesh_file.h"
#include "reference/scene/scene.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

constexpr std::size_t kMostFrames = 4;
constexpr std::string_view kBetween = "\nnext frame\n";

std::vector<std::string> frames_of(std::string_view bytes) {
  std::vector<std::string> frames;
  while (frames.size() < kMostFrames) {
    const std::size_t end = bytes.find(kBetween);
    frames.emplace_back(bytes.substr(0, end));
    if (end == bytes.npos) break;
    bytes.remove_prefix(end + kBetween.size());
  }
  return frames;
}

std::string scene_text(const std::string& extension) {
  return R"({"id": "frames", "duration": 1, "levels": ["body", "triangle"], "bodies": [)"
         R"({"name": "recorded", "recording": {"frames": "frame_%d.)" +
         extension +
         R"("}}, {"name": "fitted", "lattice": {"kept": 4, "fit": true}, )"
         R"("recording": {"frames": "frame_%d.)" +
         extension + R"("}}]})";
}

void check_promises(const scene::Scene& scene, const std::vector<std::filesystem::path>& files) {
  require(scene.frames == files.size(), "every file is a frame");
  require(scene.recorded.size() == scene.frames, "every frame is recorded");
  for (std::size_t f = 0; f < scene.frames; ++f) {
    require(scene.recorded[f].size() == 2, "every body has its nodes");
    const GivenVertices& given = scene.bodies[0].shape->given;
    require(scene.recorded[f][0] == given.kept(mesh::read_polygons(files[f]).points),
            "a body without a lattice is where its file has it");
    for (std::size_t b = 0; b < 2; ++b) {
      require(scene.recorded[f][b].size() == scene.bodies[b].shape->node_count(),
              "every node has a position");
      for (const Vec3& node : scene.recorded[f][b])
        require(node.allFinite(), "all positions are finite");
    }
  }
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(frames) {
  using namespace contactcheck;
  const std::vector<std::string> frames =
      test::frames_of({reinterpret_cast<const char*>(data), size});
  const std::string extension = frames[0].starts_with("ply") ? "ply" : "obj";
  const test::Scratch scratch;
  std::vector<std::filesystem::path> files;
  for (const std::string& frame : frames)
    files.push_back(
        scratch.write("frame_" + std::to_string(files.size()) + "." + extension, frame));
  try {
    const std::filesystem::path file = scratch.write("scene.json", test::scene_text(extension));
    test::check_promises(scene::load_scene(file), files);
  } catch (const InputError& refusal) {
    test::require_sentence(refusal.what(), scratch.folder());
  }
  return 0;
}
