#include "reference/judge/rounded_scene.h"

#include <gtest/gtest.h>

#include "core/detect/registry.h"
#include "reference/judge/accuracy.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

// In doubles the second triangle lies 2^-30 above the first; as floats near 1 both are one plane.
scene::Scene plates() {
  const double gap = 0x1p-30;
  const auto low = make_bare_shape(test::triangle_mesh({0, 0, 1}, {1, 0, 1}, {0, 1, 1}));
  const auto high =
      make_bare_shape(test::triangle_mesh({0, 0, 1 + gap}, {1, 0, 1 + gap}, {0, 1, 1 + gap}));
  scene::Scene scene =
      test::approach_scene(low, high, {}, 0, 0, 2, 1.0, {Level::kBody, Level::kTriangle});
  scene.motions = {Motion{}, Motion{}};  // both rest
  return scene;
}

JudgedScene judged(const scene::Scene& scene) {
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  return judge_scene(scene, progress);
}

TEST(RoundedScene, HasTheTruthOfTheFloatsItIsFed) {
  const scene::Scene scene = plates();
  const JudgedScene exact = judged(scene);
  EXPECT_EQ(exact.truth[1].surface.triangles.size(), 0u);
  JudgingTools tools(exact);
  RoundedScene* rounded = tools.rounded({1.0});
  ASSERT_NE(rounded, nullptr);
  EXPECT_EQ(rounded->truth(1, tools.oracle).surface.triangles.size(), 1u);
  EXPECT_EQ(rounded, tools.rounded({1.0}));
}

TEST(RoundedScene, IsInUnitsOfItsScale) {
  const scene::Scene scene = plates();
  const JudgedScene exact = judged(scene);
  JudgingTools tools(exact);
  const Frame& frame = tools.rounded({64.0})->frame(0);
  EXPECT_EQ(frame.bodies[0].vertices[1], Vec3(64, 0, 64));
}

// Compilers may leave out a way through float and back: every coordinate must have gone it.
TEST(RoundedScene, HoldsFloatsAlone) {
  const scene::Scene scene = plates();
  const JudgedScene exact = judged(scene);
  JudgingTools tools(exact);
  const Frame& frame = tools.rounded({0.1})->frame(1);
  for (const BodyState& body : frame.bodies)
    for (const Vec3& vertex : body.vertices)
      for (int k = 0; k < 3; ++k) {
        const volatile float stored = static_cast<float>(vertex[k]);
        EXPECT_EQ(vertex[k], static_cast<double>(stored));
      }
}

TEST(RoundedScene, IsNoneBeyondTheRangeOfFloats) {
  scene::Scene scene = plates();
  const JudgedScene exact = judged(scene);
  JudgingTools tools(exact);
  EXPECT_EQ(tools.rounded({1e39}), nullptr);
}

// Half the gap away from the origin between the plates, floats tell them apart.
TEST(RoundedScene, TellsApartAboutTheLocalOriginWhatIsOneFarFromTheOrigin) {
  const scene::Scene scene = plates();
  const JudgedScene exact = judged(scene);
  JudgingTools tools(exact);
  RoundedScene* local = tools.rounded({1.0, true});
  ASSERT_NE(local, nullptr);
  EXPECT_EQ(local->truth(1, tools.oracle).surface.triangles.size(), 0u);
  EXPECT_EQ(local->frame(1).bodies[0].vertices[1], Vec3(0.5, -0.5, -0x1p-31));
  EXPECT_EQ(local->frame(1).bodies[1].vertices[1], Vec3(0.5, -0.5, 0x1p-31));
  EXPECT_NE(local, tools.rounded({1.0}));
}

TEST(RoundedScene, FollowsTheLocalOriginFromFrameToFrame) {
  scene::Scene scene = plates();
  for (Motion& motion : scene.motions) motion.path.position[0].keys = {{0.0, 0.0}, {1.0, 0x1p40}};
  const JudgedScene exact = judged(scene);
  JudgingTools tools(exact);
  RoundedScene* local = tools.rounded({1.0, true});
  const Vec3 first = local->frame(0).bodies[0].vertices[1];
  EXPECT_EQ(local->frame(1).bodies[0].vertices[1], first);
}

/// Answers what is true for floats; says which precision it works in.
class FloatDetector final : public Detector {
 public:
  explicit FloatDetector(Precision precision, bool fed_vertices = true)
      : fed_vertices_(fed_vertices) {
    semantics_.levels = {Level::kBody, Level::kTriangle};
    semantics_.questions = {Question::kTriangles};
    semantics_.precision = precision;
  }
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return fed_vertices_; }
  void prepare(const std::vector<Body>&) override {}
  void update(const Frame&) override {}
  void query(Question, ContactSet& out) override { out.triangles.push_back({0, 1, 0, 0}); }

 private:
  bool fed_vertices_;
  Semantics semantics_;
};

results::Run accuracy_of(Precision precision, bool fed_vertices = true) {
  const scene::Scene scene = plates();
  const JudgedScene exact = judged(scene);
  JudgingTools tools(exact);
  FloatDetector detector(precision, fed_vertices);
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  results::Run result;
  run_accuracy(tools, 0, detector, progress, result);
  return result;
}

TEST(RoundedLevels, DoNotBookRoundingAsAnErrorOfTheAlgorithm) {
  const results::Run result = accuracy_of(Precision::kSingle);
  EXPECT_EQ(result.levels.at(Level::kTriangle).spurious, 2u);
  EXPECT_EQ(result.levels_rounded.at(Level::kTriangle).spurious, 0u);
  EXPECT_EQ(result.levels_rounded.at(Level::kTriangle).hit, 2u);
  EXPECT_TRUE(result.levels_rounded.at(Level::kBody).perfect());
}

TEST(RoundedLevels, AreForThoseThatAreFedVertices) {
  EXPECT_TRUE(accuracy_of(Precision::kSingle, false).levels_rounded.empty());
}

TEST(RoundedLevels, AreForSinglePrecisionAlone) {
  EXPECT_TRUE(accuracy_of(Precision::kDouble).levels_rounded.empty());
}

}  // namespace
}  // namespace contactcheck::judge
