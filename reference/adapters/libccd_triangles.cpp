#include <utility>

#include "core/broad/aabb_tree.h"
#include "core/detect/triangle_pair_detector.h"
#include "reference/adapters/libccd_pieces.h"

namespace contactcheck {
namespace {

/// As the detector `aabb-tree` has by default, so that the two differ in the triangle test alone.
constexpr std::uint32_t kLeafSize = 4;

class CcdTriangles {
 public:
  explicit CcdTriangles(const CcdSettings& settings) : caller_(settings) {}

  bool operator()(const TrianglePoints& p, const TrianglePoints& q) {
    return caller_.intersect(p, q);
  }
  void begin_frame() { caller_.begin_frame(); }
  std::vector<std::string> notes() const { return caller_.notes(); }
  std::uint64_t support_calls() const { return caller_.support_calls(); }

 private:
  CcdCaller caller_;
};

Semantics triangle_semantics(CcdAlgorithm algorithm) {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kTriangle};
  semantics.questions = {Question::kTriangles, Question::kBody};
  semantics.closed = algorithm == CcdAlgorithm::kGjk;
  return semantics;
}

class CcdTriangleDetector final : public TrianglePairDetector<AabbTrees, CcdTriangles> {
 public:
  explicit CcdTriangleDetector(const CcdSettings& settings)
      : TrianglePairDetector(AabbTrees(kLeafSize), CcdTriangles(settings),
                             triangle_semantics(settings.algorithm)) {}

  StageTrace trace() override {
    const std::uint64_t before = narrow().support_calls();
    StageTrace out = TrianglePairDetector::trace();
    out.stages.back().visited = narrow().support_calls() - before;
    out.stages.back().visited_unit = "support calls";
    return out;
  }
};

}  // namespace

std::unique_ptr<Detector> make_ccd_triangles(const CcdSettings& settings) {
  return std::make_unique<CcdTriangleDetector>(settings);
}

}  // namespace contactcheck
