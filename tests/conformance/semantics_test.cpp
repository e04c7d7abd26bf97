// Whether what a detector declares about itself makes sense.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/conformance/cases.h"
#include "tests/conformance/detector_test.h"

namespace contactcheck {
namespace {

class Declared : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!test::absence(GetParam()).empty()) GTEST_SKIP() << test::absence(GetParam());
    const auto detector = test::make_detector(GetParam());
    before_ = detector->semantics();
    detector->prepare(test::moving_case().bodies);
    semantics_ = detector->semantics();
  }

  Semantics before_, semantics_;  ///< before and after prepare()
};

INSTANTIATE_TEST_SUITE_P(All, Declared, ::testing::ValuesIn(test::detector_names()),
                         [](const auto& p) { return test::test_name(p.param); });

template <typename T>
bool unique(const std::vector<T>& items) {
  return std::set<T>(items.begin(), items.end()).size() == items.size();
}

TEST_P(Declared, LevelsAndQuestionsFitTogether) {
  EXPECT_FALSE(semantics_.questions.empty());
  EXPECT_TRUE(unique(semantics_.questions));
  std::vector<Level> levels = semantics_.levels;
  levels.insert(levels.end(), semantics_.informative.begin(), semantics_.informative.end());
  EXPECT_FALSE(levels.empty());
  EXPECT_TRUE(unique(levels)) << "a level is claimed or informative, not both";
  EXPECT_TRUE(!semantics_.exact || !semantics_.levels.empty()) << "exact at no level";
  if (semantics_.claims(Level::kTriangle)) {
    EXPECT_TRUE(semantics_.answers(Question::kTriangles));
  }
  if (semantics_.claims(Level::kCell)) {
    EXPECT_TRUE(semantics_.answers(Question::kCells));
  }
  EXPECT_EQ(semantics_.answers(Question::kContacts), semantics_.depth != DepthKind::kNone);
  for (const Level level : levels)
    if (is_impact(level)) {
      EXPECT_TRUE(
          semantics_.answers(is_self_impact(level) ? Question::kSelfImpacts : Question::kImpacts))
          << name_of(level);
    }
  EXPECT_EQ(any_impact(levels), test::answers_any(semantics_, test::Moment::kStep));
}

// A run asks and times the first question, and keeps frames and steps apart by it.
TEST_P(Declared, QuestionsOfFramesComeBeforeThoseOfSteps) {
  EXPECT_TRUE(std::is_partitioned(semantics_.questions.begin(), semantics_.questions.end(),
                                  [](Question question) { return !is_of_steps(question); }));
}

// Else it would be asked about what it was never given.
TEST_P(Declared, UpdatesOfWhatItIsNotAskedAboutThrow) {
  const test::Case& scene = test::moving_case();
  const auto detector = test::make_detector(GetParam());
  detector->prepare(scene.bodies);
  if (!test::answers_any(semantics_, test::Moment::kFrame)) {
    EXPECT_THROW(detector->update(scene.frames[0].frame()), std::logic_error);
  }
  if (!test::answers_any(semantics_, test::Moment::kStep) &&
      semantics_.precision == Precision::kDouble) {
    EXPECT_THROW(detector->update_step({scene.frames[0].frame(), scene.frames[1].frame()}),
                 std::logic_error);
  }
}

TEST_P(Declared, MarginAndScaleAreUsable) {
  EXPECT_TRUE(std::isfinite(semantics_.margin));
  EXPECT_GE(semantics_.margin, 0.0);
  if (semantics_.claims(Level::kNear) || semantics_.claims(Level::kSelfNear)) {
    EXPECT_GT(semantics_.margin, 0.0) << "nothing is nearer than 0";
  }
  // A margin without the level `near` changes what contact is.
  EXPECT_TRUE(semantics_.margin == 0.0 || semantics_.claims(Level::kNear) ||
              !semantics_.means.empty());
  EXPECT_TRUE(std::isfinite(semantics_.scale));
  EXPECT_GT(semantics_.scale, 0.0);
  if (semantics_.precision == Precision::kDouble) {
    EXPECT_EQ(semantics_.scale, 1.0);
    EXPECT_FALSE(semantics_.local_origin);
  }
  if (semantics_.local_origin) {
    EXPECT_EQ(semantics_.scale, 1.0);
  }
}

// Only a scale, and a margin with it, may be taken from the bodies.
TEST_P(Declared, BeforeAndAfterPrepareAreTheSame) {
  EXPECT_EQ(before_.levels, semantics_.levels);
  EXPECT_EQ(before_.informative, semantics_.informative);
  EXPECT_EQ(before_.questions, semantics_.questions);
  EXPECT_EQ(before_.solid, semantics_.solid);
  EXPECT_EQ(before_.closed, semantics_.closed);
  EXPECT_EQ(before_.exact, semantics_.exact);
  EXPECT_EQ(before_.precision, semantics_.precision);
  EXPECT_EQ(before_.local_origin, semantics_.local_origin);
  EXPECT_EQ(before_.depth, semantics_.depth);
  EXPECT_EQ(before_.means, semantics_.means);
}

TEST(DetectorNames, AreNamedOnceAlsoInLettersAndDigits) {
  std::set<std::string> names;
  for (const std::string& detector : test::detector_names())
    EXPECT_TRUE(names.insert(test::test_name(detector)).second) << detector;
  EXPECT_GT(names.size(), 10u);
}

TEST(DetectorNames, OfVariantsAreCanonical) {
  for (const std::string& detector : test::detector_names())
    EXPECT_EQ(test::catalogue().parse(detector).name, detector);
}

}  // namespace
}  // namespace contactcheck
