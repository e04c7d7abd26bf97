// Every measure of accuracy, green and red, on results written by hand.
#include <gmock/gmock.h>

#include <ostream>

#include "tests/reference/gate/gate_world.h"

namespace contactcheck::gate {
namespace {

using Json = nlohmann::ordered_json;
using test::check_of;
using test::checks_of;
using test::row_of;
using test::sample_results;
using testing::HasSubstr;

struct MeasureCase {
  std::string name, detector, green, red, measured, allowed, frame;
};
void PrintTo(const MeasureCase& c, std::ostream* out) { *out << c.name; }

class AccuracyMeasure : public testing::TestWithParam<MeasureCase> {};

TEST_P(AccuracyMeasure, PassesAtItsLimitAndFailsBeyond) {
  const MeasureCase& c = GetParam();
  const Check green = check_of(c.detector, c.green, sample_results());
  EXPECT_EQ(green.verdict, Verdict::kPass) << sentence_of(green);
  EXPECT_FALSE(green.red);
  EXPECT_EQ(green.measured, c.measured);
  const Check red = check_of(c.detector, c.red, sample_results());
  EXPECT_EQ(red.verdict, Verdict::kFail);
  EXPECT_TRUE(red.red);
  EXPECT_EQ(red.measured, c.measured);
  EXPECT_EQ(red.allowed, c.allowed);
  EXPECT_EQ(red.frame, c.frame);
  EXPECT_NE(red.rerun, "");
}

INSTANTIATE_TEST_SUITE_P(
    Measures, AccuracyMeasure,
    testing::Values(
        MeasureCase{"Recall", "paper", "'measure': 'recall', 'at_least': 0.925",
                    "'measure': 'recall', 'at_least': 0.93", "recall 0.925 at level cell",
                    "at least 0.93", "frame 5"},
        MeasureCase{"Missed", "paper", "'measure': 'missed', 'at_most': 3",
                    "'measure': 'missed', 'at_most': 2", "missed 3 at level cell", "at most 2",
                    "frame 5"},
        MeasureCase{"MissedOfANamedLevel", "paper",
                    "'measure': 'missed', 'level': 'cell', 'at_least': 3",
                    "'measure': 'missed', 'level': 'cell', 'at_least': 4", "missed 3 at level cell",
                    "at least 4", "frame 5"},
        MeasureCase{"Spurious", "paper", "'measure': 'spurious', 'at_most': 2",
                    "'measure': 'spurious', 'at_most': 1", "spurious 2 at level cell", "at most 1",
                    "frame 5"},
        // Not the level of the counts per frame: the list of disagreements knows one.
        MeasureCase{"SpuriousBodies", "paper",
                    "'measure': 'spurious', 'level': 'body', 'at_most': 1",
                    "'measure': 'spurious', 'level': 'body', 'at_most': 0",
                    "spurious 1 at level body", "at most 0", "frame 2"},
        MeasureCase{"SpuriousRate", "paper", "'measure': 'spurious_rate', 'at_most': 0.1",
                    "'measure': 'spurious_rate', 'at_most': 0.09",
                    "spurious_rate 0.1 at level cell", "at most 0.09", "frame 5"},
        MeasureCase{"MissedLength", "paper", "'measure': 'missed_length', 'at_most': 0.5",
                    "'measure': 'missed_length', 'at_most': 0.25", "missed_length 0.5 m",
                    "at most 0.25 m", "frame 5"},
        MeasureCase{"CoveredLength", "paper",
                    "'measure': 'covered_length_fraction', 'at_least': 0.9",
                    "'measure': 'covered_length_fraction', 'at_least': 0.91",
                    "covered_length_fraction 0.9", "at least 0.91", "frame 5"},
        MeasureCase{"SpuriousDistance", "paper",
                    "'measure': 'spurious_distance_max', 'at_most': 0.25",
                    "'measure': 'spurious_distance_max', 'at_most': 0.2",
                    "spurious_distance_max 0.25 m", "at most 0.2 m", "frame 5"},
        MeasureCase{"DepthMax", "paper", "'measure': 'depth_error_max', 'at_most': 0.03",
                    "'measure': 'depth_error_max', 'at_most': 0.02", "depth_error_max 0.03 m",
                    "at most 0.02 m", ""},
        MeasureCase{"DepthP95", "paper", "'measure': 'depth_error_p95', 'at_most': 0.02",
                    "'measure': 'depth_error_p95', 'at_most': 0.01", "depth_error_p95 0.02 m",
                    "at most 0.01 m", ""},
        MeasureCase{"DepthMean", "paper", "'measure': 'depth_error_mean', 'at_most': 0.01",
                    "'measure': 'depth_error_mean', 'at_most': 0.001", "depth_error_mean 0.01 m",
                    "at most 0.001 m", ""},
        MeasureCase{"NormalMax", "paper", "'measure': 'normal_error_deg_max', 'at_most': 30",
                    "'measure': 'normal_error_deg_max', 'at_most': 29",
                    "normal_error_deg_max 30 degrees", "at most 29 degrees", ""},
        MeasureCase{"NormalP95", "paper", "'measure': 'normal_error_deg_p95', 'at_most': 20",
                    "'measure': 'normal_error_deg_p95', 'at_most': 19",
                    "normal_error_deg_p95 20 degrees", "at most 19 degrees", ""},
        MeasureCase{"NormalMean", "paper", "'measure': 'normal_error_deg_mean', 'at_most': 10",
                    "'measure': 'normal_error_deg_mean', 'at_most': 9",
                    "normal_error_deg_mean 10 degrees", "at most 9 degrees", ""},
        MeasureCase{"HoverGap", "paper", "'measure': 'hover_gap_max', 'at_most': 0.125",
                    "'measure': 'hover_gap_max', 'at_most': 0.1", "hover_gap_max 0.125 m",
                    "at most 0.1 m", ""},
        MeasureCase{"LateFrames", "paper", "'measure': 'late_frames', 'at_least': -2",
                    "'measure': 'late_frames', 'at_least': -1", "late_frames -2", "at least -1",
                    ""},
        MeasureCase{"StagesTogether", "paper", "'measure': 'stage_missed', 'at_most': 3",
                    "'measure': 'stage_missed', 'at_most': 2", "stage_missed 3", "at most 2",
                    "frame 5"},
        MeasureCase{"OneStage", "paper",
                    "'measure': 'stage_missed', 'stage': 'spheres', 'at_most': 1",
                    "'measure': 'stage_missed', 'stage': 'spheres', 'at_most': 0",
                    "stage_missed 1 in stage spheres", "at most 0", "frame 5"},
        MeasureCase{"Memory", "paper", "'measure': 'memory_bytes', 'at_most': 2000",
                    "'measure': 'memory_bytes', 'at_most': 1999", "memory_bytes 2000 bytes",
                    "at most 1999 bytes", ""}),
    [](const testing::TestParamInfo<MeasureCase>& test) { return test.param.name; });

struct Injection {
  std::string name, detector, rule, pointer;
  Json value;
  std::string measured;
};
void PrintTo(const Injection& c, std::ostream* out) { *out << c.name; }

class InjectedError : public testing::TestWithParam<Injection> {};

TEST_P(InjectedError, TurnsAGreenGateRed) {
  const Injection& c = GetParam();
  Json results = sample_results();
  EXPECT_FALSE(check_of(c.detector, c.rule, results).red);
  row_of(results, "touch", c.detector).at(Json::json_pointer(c.pointer)) = c.value;
  const Check check = check_of(c.detector, c.rule, results);
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_EQ(check.measured, c.measured);
}

INSTANTIATE_TEST_SUITE_P(
    Gate, InjectedError,
    testing::Values(Injection{"MissedContact", "exact", "'measure': 'missed', 'at_most': 0",
                              "/levels/triangle/missed", 1, "missed 1 at level triangle"},
                    Injection{"SpuriousContact", "exact", "'measure': 'spurious', 'at_most': 0",
                              "/levels/triangle/spurious", 1, "spurious 1 at level triangle"},
                    Injection{"OtherContacts", "exact",
                              "'measure': 'contact_hash', 'equals': 'truth'", "/contact_hash",
                              "0xf", "contact_hash 0xf"},
                    Injection{"LossOfAStage", "exact", "'measure': 'stage_missed', 'at_most': 0",
                              "/stages/1/missed", 1, "stage_missed 1"}),
    [](const testing::TestParamInfo<Injection>& test) { return test.param.name; });

TEST(ContactHash, EqualToTheTruthPasses) {
  EXPECT_EQ(
      check_of("exact", "'measure': 'contact_hash', 'equals': 'truth'", sample_results()).verdict,
      Verdict::kPass);
}

constexpr const char* kUnchangedHash = "'measure': 'contact_hash', 'unchanged': true";

TEST(ContactHash, OfTheBaselinePasses) {
  const Json baseline = sample_results();
  const Check check = check_of("paper", kUnchangedHash, sample_results(), &baseline);
  EXPECT_EQ(check.verdict, Verdict::kPass);
  EXPECT_EQ(check.allowed, "0xd, that of the baseline");
}

TEST(ContactHash, ChangedByTheDetectorFailsAndSaysSo) {
  const Json baseline = sample_results();
  Json results = sample_results();
  row_of(results, "touch", "paper")["contact_hash"] = "0xdd";
  const Check check = check_of("paper", kUnchangedHash, results, &baseline);
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_TRUE(check.red);
  EXPECT_EQ(check.measured, "contact_hash 0xdd");
  EXPECT_EQ(check.reason, "the truth is as it was: the detector's answer changed");
  EXPECT_EQ(check.frame, "frame 5");
}

TEST(ContactHash, ChangedWithTheTruthSaysSo) {
  const Json baseline = sample_results();
  Json results = sample_results();
  row_of(results, "touch", "paper")["contact_hash"] = "0xdd";
  results["scenes"][0]["truth_hash"] = "0xaa";
  EXPECT_THAT(check_of("paper", kUnchangedHash, results, &baseline).reason,
              HasSubstr("the truth changed as well"));
}

TEST(ContactHash, OfOtherFramesSaysSo) {
  const Json baseline = sample_results();
  Json results = sample_results();
  row_of(results, "touch", "paper")["contact_hash"] = "0xdd";
  row_of(results, "touch", "paper")["frames"] = 4;
  EXPECT_EQ(check_of("paper", kUnchangedHash, results, &baseline).reason,
            "the run has 4 frames, the baseline 8");
}

TEST(UnchangedNumber, FailsInBothDirections) {
  const Json baseline = sample_results();
  const char* const rule = "'measure': 'missed', 'unchanged': true";
  EXPECT_EQ(check_of("paper", rule, sample_results(), &baseline).verdict, Verdict::kPass);
  for (const int missed : {2, 4}) {
    Json results = sample_results();
    row_of(results, "touch", "paper")["levels"]["cell"]["missed"] = missed;
    const Check check = check_of("paper", rule, results, &baseline);
    EXPECT_EQ(check.verdict, Verdict::kFail) << missed;
    EXPECT_EQ(check.allowed, "3, that of the baseline");
  }
}

TEST(Status, IsOkOrFails) {
  const char* const rule = "'measure': 'status', 'equals': 'ok'";
  EXPECT_EQ(check_of("exact", rule, sample_results()).verdict, Verdict::kPass);
  const Check broken = check_of("broken", rule, sample_results());
  EXPECT_TRUE(broken.red);
  EXPECT_EQ(broken.measured, "status error");
  EXPECT_EQ(broken.reason, "signal 11 in a query");
  EXPECT_EQ(broken.frame, "frame 4");
  EXPECT_TRUE(check_of("lost", rule, sample_results()).red) << "a policy may demand presence";
}

TEST(RowInError, FailsEveryRuleThatCoversIt) {
  const Check check =
      check_of("broken", "'measure': 'memory_bytes', 'at_most': 9", sample_results());
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_TRUE(check.red);
  EXPECT_EQ(sentence_of(check),
            "touch  broken: status error, allowed at most 9 bytes, frame 4; signal 11 in a query");
}

TEST(RowInError, PassesWhereThePolicySaysSo) {
  const Check check = check_of("broken", "'measure': 'memory_bytes', 'at_most': 9, 'error': 'pass'",
                               sample_results());
  EXPECT_EQ(check.verdict, Verdict::kCannotJudge);
  EXPECT_FALSE(check.red);
}

Json with_a_refusal() {
  Json results = sample_results();
  Json& row = row_of(results, "touch", "broken");
  row["status"] = "refused";
  row["message"] = "a coordinate is too large";
  return results;
}

TEST(RowThatIsRefused, FailsEveryRuleThatCoversIt) {
  for (const char* rule :
       {"'measure': 'memory_bytes', 'at_most': 9", "'measure': 'contact_hash', 'equals': 'truth'",
        "'measure': 'speedup', 'question': 'triangles', 'reference': 'ref', "
        "'at_least': 1"}) {
    const Check check = check_of("broken", rule, with_a_refusal());
    EXPECT_EQ(check.verdict, Verdict::kFail) << rule;
    EXPECT_TRUE(check.red);
    EXPECT_EQ(check.measured, "status refused");
    EXPECT_EQ(check.reason, "a coordinate is too large");
    EXPECT_EQ(check.frame, "frame 4");
  }
}

TEST(RowThatIsRefused, PassesWhereThePolicySaysSo) {
  const Check check = check_of(
      "broken", "'measure': 'memory_bytes', 'at_most': 9, 'refused': 'pass'", with_a_refusal());
  EXPECT_EQ(check.verdict, Verdict::kCannotJudge);
  EXPECT_FALSE(check.red);
  EXPECT_TRUE(
      check_of("broken", "'measure': 'status', 'equals': 'ok', 'refused': 'pass'", with_a_refusal())
          .red)
      << "a rule about the status itself";
}

TEST(RowThatIsAbsent, CannotBeJudged) {
  const char* const rule = "'measure': 'missed', 'at_most': 0";
  const Check check = check_of("lost", rule, sample_results());
  EXPECT_EQ(check.verdict, Verdict::kCannotJudge);
  EXPECT_FALSE(check.red);
  EXPECT_EQ(check.reason, "absent: not built");
  EXPECT_TRUE(check_of("lost", std::string(rule) + ", 'unjudged': 'fail'", sample_results()).red);
}

struct Unjudged {
  std::string name, detector, rule, reason;
};
void PrintTo(const Unjudged& c, std::ostream* out) { *out << c.name; }

class WhatIsNotThere : public testing::TestWithParam<Unjudged> {};

TEST_P(WhatIsNotThere, CannotBeJudged) {
  const Unjudged& c = GetParam();
  const Check check = check_of(c.detector, c.rule, sample_results());
  EXPECT_EQ(check.verdict, Verdict::kCannotJudge);
  EXPECT_FALSE(check.red);
  EXPECT_EQ(check.reason, c.reason);
  EXPECT_TRUE(check_of(c.detector, c.rule + ", 'unjudged': 'fail'", sample_results()).red);
}

INSTANTIATE_TEST_SUITE_P(
    Gate, WhatIsNotThere,
    testing::Values(
        Unjudged{"InformativeLevel", "single",
                 "'measure': 'missed', 'level': 'vertex', 'at_most': 0",
                 "level vertex is informative for this detector: shown, never gated"},
        Unjudged{"NoLevelAtAll", "single", "'measure': 'missed', 'at_most': 0",
                 "no level that the detector claims was judged"},
        Unjudged{"LevelWithoutTruth", "exact",
                 "'measure': 'missed', 'level': 'vertex', 'at_most': 0",
                 "level vertex is not judged: not judged: open"},
        Unjudged{"LevelThatIsNotClaimed", "exact",
                 "'measure': 'missed', 'level': 'box', 'at_most': 0",
                 "level box is not judged: the detector does not claim it, or the scene does not "
                 "ask for it"},
        Unjudged{"NoDepth", "exact", "'measure': 'depth_error_max', 'at_most': 1",
                 "depth_error_max was not measured in this row"},
        Unjudged{"NoSuchStage", "exact",
                 "'measure': 'stage_missed', 'stage': 'spheres', 'at_most': 0",
                 "the detector has no stage \"spheres\""},
        Unjudged{"NoStages", "single", "'measure': 'stage_missed', 'at_most': 0",
                 "the detector has no stages"}),
    [](const testing::TestParamInfo<Unjudged>& test) { return test.param.name; });

TEST(RecallOverNothing, CannotBeJudged) {
  Json results = sample_results();
  row_of(results, "touch", "paper")["levels"]["cell"]["recall"] = nullptr;
  row_of(results, "touch", "paper")["levels"]["cell"]["spurious_rate"] = nullptr;
  EXPECT_EQ(check_of("paper", "'measure': 'recall', 'at_least': 1", results).reason,
            "there is no true contact at level cell");
  EXPECT_EQ(check_of("paper", "'measure': 'spurious_rate', 'at_most': 0", results).reason,
            "nothing was reported at level cell");
}

TEST(NumberOfOneSideAlone, IsAChange) {
  Json with = sample_results();
  row_of(with, "touch", "exact")["geometry"]["depth_error_max"] = 0.25;
  const Json without = sample_results();
  const std::string rule = "'measure': 'depth_error_max', 'unchanged': true";
  const Check lost = check_of("exact", rule, without, &with);
  EXPECT_EQ(lost.verdict, Verdict::kFail);
  EXPECT_EQ(lost.reason,
            "was 0.25, that of the baseline; now depth_error_max was not measured in this row");
  const Check found = check_of("exact", rule, with, &without);
  EXPECT_EQ(found.verdict, Verdict::kFail);
  EXPECT_EQ(found.allowed, "none, that of the baseline");
  EXPECT_EQ(check_of("exact", rule, without, &without).verdict, Verdict::kCannotJudge);
}

TEST(RowThatTheBaselineLacks, CannotBeCompared) {
  Json baseline = sample_results();
  baseline["runs"].erase(0);
  EXPECT_EQ(check_of("exact", kUnchangedHash, sample_results(), &baseline).reason,
            "the baseline has no such row");
  baseline = sample_results();
  row_of(baseline, "touch", "exact")["status"] = "error";
  EXPECT_EQ(check_of("exact", kUnchangedHash, sample_results(), &baseline).reason,
            "in the baseline its status is error");
}

TEST(RoundedInput, IsJudgedWhereTheRuleSaysSo) {
  Json results = sample_results();
  Json& row = row_of(results, "touch", "paper");
  row["levels_rounded"] = row["levels"];
  row["levels_rounded"]["cell"]["missed"] = 1;
  const Check check =
      check_of("paper", "'measure': 'missed', 'rounded': true, 'at_most': 0", results);
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_EQ(check.measured, "missed 1 at level cell of the rounded input");
  EXPECT_EQ(check.frame, "") << "the counts per frame are of the doubles";
  EXPECT_EQ(
      check_of("paper", "'measure': 'missed', 'rounded': true, 'at_most': 1", results).verdict,
      Verdict::kPass);
  EXPECT_EQ(check_of("exact", "'measure': 'missed', 'rounded': true, 'at_most': 0", results).reason,
            "the detector is fed doubles: nothing is rounded");
}

constexpr const char* kDefectsRule =
    "'scenes': ['hard-gap'], 'detectors': ['exact'], 'measure': 'known_defects', 'at_most': 0";

TEST(KnownDefects, FailWhenUnlistedNotShownOrOfAnotherCount) {
  for (const char* list : {"unlisted", "not_shown", "changed"}) {
    Json results = sample_results();
    EXPECT_EQ(checks_of(kDefectsRule, results).at(0).verdict, Verdict::kPass);
    results["known_defects"][list] = {
        {{"detector", "exact"}, {"scene", "hard-gap"}, {"kind", "missed"}, {"values", {"0", "1"}}}};
    const Check check = checks_of(kDefectsRule, results).at(0);
    EXPECT_EQ(check.verdict, Verdict::kFail) << list;
    EXPECT_EQ(check.measured, "known_defects 2");
    EXPECT_EQ(check.rerun, "contactcheck run hard-gap --detector exact --no-timing");
    results["known_defects"][list][0]["detector"] = "other";
    EXPECT_EQ(checks_of(kDefectsRule, results).at(0).verdict, Verdict::kPass) << "of its own row";
  }
}

TEST(KnownDefects, CannotBeJudgedWithoutHardCases) {
  Json results = sample_results();
  results.erase("known_defects");
  EXPECT_EQ(checks_of(kDefectsRule, results).at(0).verdict, Verdict::kCannotJudge);
}

TEST(OracleWrong, IsOfTheScenesWithRandomPairs) {
  const char* const rule = "'scenes': ['*'], 'measure': 'oracle_wrong', 'at_most': 0";
  Json results = sample_results();
  auto checks = checks_of(rule, results);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].verdict, Verdict::kPass);
  results["scenes"][2]["pairs"]["rational"]["oracle_wrong"] = 1;
  checks = checks_of(rule, results);
  EXPECT_TRUE(checks.at(0).red);
  EXPECT_EQ(sentence_of(checks[0]), "random-pairs  oracle: oracle_wrong 1, allowed at most 0");
  EXPECT_EQ(checks[0].rerun, "contactcheck run --pairs 64 --seed 7");
}

}  // namespace
}  // namespace contactcheck::gate
