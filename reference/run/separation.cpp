#include "reference/run/separation.h"

namespace contactcheck {

std::vector<double> separations(const JudgedScene& judged, ProgressWriter& progress) {
  const Scene& scene = *judged.scene;
  std::vector<double> out;
  if (scene.family || scene.pairs || scene.bodies.size() < 2) return out;
  Oracle oracle(scene.bodies);
  for (std::size_t f = 0; f < scene.frames; ++f) {
    progress.enter(SharedProgress::kNoDetector, f, Phase::kTruth);
    out.push_back(judged.contact_frames[f] ? 0.0 : oracle.separation(judged.frame(f)).upper);
  }
  return out;
}

}  // namespace contactcheck
