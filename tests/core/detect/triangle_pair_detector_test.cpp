#include "core/detect/triangle_pair_detector.h"

#include <gmock/gmock.h>

#include "tests/core/detect/bare_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::FrameData;
using test::prepared;
using test::scaled;
using test::Scene;
using test::still;
using ::testing::ElementsAre;
using ::testing::SizeIs;

/// Names every pair of triangles twice, pairs of bodies mixed, and never stops.
struct CarelessBroad {
  using Real = double;
  static constexpr const char* kName = "careless";
  static constexpr const char* kVisitedUnit = "pairs";
  static constexpr bool kBoxesOverlap = false;
  void prepare(const std::vector<Body>& bodies) { count = bodies.size(); }
  void update(const std::vector<std::span<const Vec3>>&) {}
  template <typename Visit>
  void visit_candidates(Visit&& visit) {
    for (std::uint32_t t = 0; t < 24; ++t)
      for (std::uint32_t b = 1; b < count; ++b)
        for (std::uint32_t a = 0; a < b; ++a) visit(ElementPair{b, a, t % 12, t % 12});
  }
  std::uint64_t visited() const { return 0; }
  std::size_t count = 0;
};

/// Counts; says yes to everything.
struct CountingNarrow {
  bool operator()(const TrianglePoints&, const TrianglePoints&) {
    ++calls;
    return true;
  }
  void begin_frame() { calls = 0; }
  std::vector<std::string> notes() const { return {std::to_string(calls) + " calls"}; }
  int calls = 0;
};

using Careless = TrianglePairDetector<CarelessBroad, CountingNarrow>;

TEST(TrianglePairDetector, ReportsEachPairOfBodiesOnceAndTestsNoneAfterwards) {
  const Scene scene =
      still({test::unit_box_mesh(1), test::unit_box_mesh(1), test::unit_box_mesh(1)});
  Careless detector(CarelessBroad{}, CountingNarrow{}, exact_triangle_semantics());
  detector.prepare(scene.bodies);
  const Frame frame = scene.frames[0].frame();
  detector.update(frame);
  ContactSet out;
  detector.query(Question::kBody, out);
  EXPECT_THAT(out.bodies, SizeIs(3));
  EXPECT_THAT(detector.notes(), ElementsAre("3 calls"));
  out.canonicalize();
  EXPECT_THAT(out.bodies, ElementsAre(BodyPair{0, 1}, BodyPair{0, 2}, BodyPair{1, 2}));
}

TEST(TrianglePairDetector, ComparesBoxesBeforeTheTestAndTellsItOfNewFrames) {
  const TriangleMesh cube = test::unit_box_mesh(1);
  const Scene scene = still({cube, scaled(cube, 1.0, Vec3(5, 0, 0))});
  Careless detector(CarelessBroad{}, CountingNarrow{}, exact_triangle_semantics());
  detector.prepare(scene.bodies);
  FrameData together = scene.frames[0];
  together.vertices[1] = together.vertices[0];
  answer(detector, together, Question::kTriangles);
  EXPECT_THAT(detector.notes(), ElementsAre("24 calls"));
  answer(detector, scene.frames[0], Question::kTriangles);
  EXPECT_THAT(detector.notes(), ElementsAre("0 calls"));
}

TEST(TrianglePairDetectorDeathTest, FramesAndQuestionsMustFit) {
  const Scene scene = still({test::unit_box_mesh(1), test::unit_box_mesh(1)});
  const auto detector = prepared("aabb-tree", scene);
  FrameData frame = scene.frames[0];
  frame.vertices[1].pop_back();
  EXPECT_DEATH(answer(*detector, frame), "one position per vertex");
  frame.vertices.pop_back();
  frame.nodes.pop_back();
  EXPECT_DEATH(answer(*detector, frame), "one state per prepared body");
  EXPECT_DEATH(answer(*detector, scene.frames[0], Question::kCells), "only claimed questions");
}

}  // namespace
}  // namespace contactcheck
