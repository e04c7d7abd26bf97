#include "reference/run/judged_scene.h"

namespace contactcheck {
namespace {

std::string first_non_finite(const Scene& scene, std::size_t frame,
                             const std::vector<std::vector<Vec3>>& nodes) {
  for (std::size_t b = 0; b < nodes.size(); ++b)
    for (std::size_t n = 0; n < nodes[b].size(); ++n)
      if (!nodes[b][n].allFinite())
        return "frame " + std::to_string(frame) + ", body \"" + scene.bodies[b].name + "\": node " +
               std::to_string(n) + " is not finite";
  return "";
}

std::vector<double> contour_of(const Truth& truth, const SurfaceGeometry& geometry) {
  std::vector<double> lengths;
  lengths.reserve(truth.surface.triangles.size());
  for (const ElementPair& pair : truth.surface.triangles)
    lengths.push_back(geometry.intersection_length(pair));
  return lengths;
}

}  // namespace

Frame make_frame(std::size_t index, double time, const std::vector<std::vector<Vec3>>& nodes,
                 const std::vector<std::vector<Vec3>>& vertices) {
  Frame frame;
  frame.index = index;
  frame.time = time;
  for (std::size_t b = 0; b < nodes.size(); ++b) frame.bodies.push_back({nodes[b], vertices[b]});
  return frame;
}

WantedTruth wanted_truth(const Scene& scene) {
  WantedTruth wanted;
  wanted.containment = scene.judges(Level::kContainment);
  wanted.vertices = scene.judges(Level::kVertex);
  wanted.boxes = scene.judges(Level::kBox);
  return wanted;
}

Frame JudgedScene::frame(std::size_t index) const {
  const FramePosition& position = positions[index];
  return make_frame(index, scene->time_of(index), position.nodes, position.vertices);
}

JudgedScene judge_scene(const Scene& scene, ProgressWriter& progress) {
  JudgedScene judged;
  judged.scene = &scene;
  judged.positions = FramePositions(scene);
  Oracle oracle(scene.bodies);
  SurfaceGeometry geometry(scene.bodies);
  std::optional<PairCheck> check;
  if (scene.pairs) check.emplace(*scene.pairs);
  for (std::size_t f = 0; f < scene.frames; ++f) {
    progress.enter(SharedProgress::kNoDetector, f, Phase::kTruth);
    judged.refused = first_non_finite(scene, f, judged.positions[f].nodes);
    if (!judged.refused.empty()) return judged;
    judged.truth.push_back(oracle.judge(judged.frame(f), wanted_truth(scene)));
    judged.contact_frames.push_back(!judged.truth.back().surface.bodies.empty());
    if (check) {
      check->add_frame(f, judged.positions[f].vertices, judged.truth.back());
      progress.part(kShareOfTruth * static_cast<double>(f) / static_cast<double>(scene.frames));
    }
    if (!scene.grades_lengths()) continue;
    geometry.set_frame(judged.frame(f));
    judged.contour.push_back(contour_of(judged.truth.back(), geometry));
  }
  if (check) judged.pairs = check->tally();
  return judged;
}

}  // namespace contactcheck
