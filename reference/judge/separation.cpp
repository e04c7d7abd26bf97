#include "reference/judge/separation.h"

namespace contactcheck::judge {

std::vector<double> separations(const JudgedScene& judged, process::ProgressWriter& progress) {
  const scene::Scene& scene = *judged.scene;
  std::vector<double> out;
  if (scene.family || scene.pairs || scene.bodies.size() < 2) return out;
  oracle::Oracle oracle(scene.bodies);
  for (std::size_t f = 0; f < scene.frames; ++f) {
    progress.enter(process::SharedProgress::kNoDetector, f, process::Phase::kTruth);
    out.push_back(judged.contact_frames[f] ? 0.0 : oracle.separation(judged.frame(f)).upper);
  }
  return out;
}

}  // namespace contactcheck::judge
