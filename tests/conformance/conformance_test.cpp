// The answers of every detector in every case, held against what it claims.
#include <gtest/gtest.h>

#include "tests/conformance/cases.h"
#include "tests/conformance/detector_test.h"

namespace contactcheck {
namespace {

using test::CaseGroup;

class Answers : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!test::absence(GetParam()).empty()) GTEST_SKIP() << test::absence(GetParam());
  }
  void expect_as_claimed(CaseGroup group) {
    for (const test::Case& c : test::cases_of(group)) expect_as_claimed(c);
  }
  void expect_as_claimed(const test::Case& c) {
    test::expect_as_known(GetParam(), c.name, test::observe(test::maker_of(GetParam()), c));
  }
};

INSTANTIATE_TEST_SUITE_P(All, Answers,
                         ::testing::ValuesIn(test::detector_names(test::Moment::kFrame)),
                         [](const auto& p) { return test::test_name(p.param); });

TEST_P(Answers, ToScenesOfNoneAndOneBody) { expect_as_claimed(CaseGroup::kFew); }
TEST_P(Answers, ToBodiesThatTouch) { expect_as_claimed(CaseGroup::kTouching); }
TEST_P(Answers, ToBodiesThatOverlap) { expect_as_claimed(CaseGroup::kOverlapping); }
TEST_P(Answers, ToBodiesWhoseSurfacesAreApart) { expect_as_claimed(CaseGroup::kSeparate); }
TEST_P(Answers, ToEightIdenticalBodies) { expect_as_claimed(CaseGroup::kMany); }
TEST_P(Answers, ToDegenerateMeshes) { expect_as_claimed(CaseGroup::kDegenerate); }
TEST_P(Answers, ToBodiesOfManySizes) { expect_as_claimed(CaseGroup::kSizes); }
TEST_P(Answers, ToBodiesThatDeform) { expect_as_claimed(test::moving_case()); }

class StepAnswers : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, StepAnswers,
                         ::testing::ValuesIn(test::detector_names(test::Moment::kStep)),
                         [](const auto& p) { return test::test_name(p.param); });

TEST_P(StepAnswers, AreAsClaimed) {
  for (const test::Case& c : test::step_cases())
    test::expect_as_known(GetParam(), c.name, test::observe_steps(test::maker_of(GetParam()), c));
}

}  // namespace
}  // namespace contactcheck
