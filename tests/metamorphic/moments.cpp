#include "tests/metamorphic/moments.h"

#include <algorithm>
#include <set>

#include "tests/conformance/answers.h"
#include "tests/conformance/detectors.h"

namespace contactcheck::test {
namespace {

// By a fast detector: a wrong count would only choose another frame.
std::vector<std::size_t> pairs_per_frame(const scene::Scene& scene) {
  const auto detector = make_detector("full-refit");
  detector->prepare(scene.bodies);
  std::vector<std::size_t> counts;
  for (std::size_t f = 0; f < scene.frames; ++f) {
    const FrameData data = make_frame(scene.bodies, scene.nodes_of_frame(f));
    detector->update(data.frame(f));
    ContactSet found;
    detector->query(Question::kTriangles, found);
    counts.push_back(found.triangles.size());
  }
  return counts;
}

}  // namespace

Subject telling_moments(const scene::Scene& scene) {
  const std::vector<std::size_t> pairs = pairs_per_frame(scene);
  std::set<std::size_t> chosen = {0, scene.frames - 1};
  const auto touched =
      std::find_if(pairs.begin(), pairs.end(), [](std::size_t n) { return n > 0; });
  if (touched != pairs.end()) {
    chosen.insert(static_cast<std::size_t>(touched - pairs.begin()));
    const auto deepest = std::max_element(pairs.begin(), pairs.end());
    chosen.insert(static_cast<std::size_t>(deepest - pairs.begin()));
  }
  Subject out{scene.bodies, {}, {}};
  for (std::size_t f : chosen) {
    out.frames.push_back(make_frame(scene.bodies, scene.nodes_of_frame(f)));
    out.labels.push_back(scene.id + " frame " + std::to_string(f));
  }
  return out;
}

}  // namespace contactcheck::test
