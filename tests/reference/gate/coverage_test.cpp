// What a gate must not pass over in silence.
#include <gmock/gmock.h>

#include "core/types/check.h"
#include "reference/gate/gate.h"
#include "reference/results/results_json.h"
#include "tests/reference/gate/gate_world.h"

namespace contactcheck::gate {
namespace {

using Json = nlohmann::ordered_json;
using test::checks_of;
using test::row_of;
using test::sample_results;

constexpr const char* kHolds =
    "'scenes': ['touch'], 'detectors': ['exact'], 'measure': 'missed', "
    "'at_most': 0";

std::vector<std::string> red_sentences(const std::vector<Check>& checks) {
  std::vector<std::string> out;
  for (const Check& check : checks)
    if (check.red) out.push_back(check.rule + ": " + sentence_of(check));
  return out;
}

TEST(RuleThatMatchesNothing, IsBroken) {
  const auto checks =
      checks_of("'scenes': ['tuch'], 'detectors': ['exact'], 'measure': 'missed', 'at_most': 0",
                sample_results());
  EXPECT_THAT(red_sentences(checks),
              testing::ElementsAre(testing::AllOf(
                  testing::StartsWith("R: matches nothing: no row has a scene of \"tuch\" and a "
                                      "detector of \"exact\"; the results have the scenes "),
                  testing::HasSubstr("\"touch\""))));
  EXPECT_THAT(red_sentences(checks_of("'scenes': ['touch'], 'detectors': ['exakt'], "
                                      "'measure': 'missed', 'at_most': 0",
                                      sample_results())),
              testing::ElementsAre(testing::HasSubstr("; the results have the detectors \"")));
}

TEST(PatternThatMatchesNothing, IsBrokenBesideOnesThatDo) {
  const auto checks = checks_of(
      "'scenes': ['*'], 'detectors': ['exact', 'ex?ct2'], 'measure': 'missed', 'at_most': 0",
      sample_results());
  EXPECT_EQ(checks.size(), 4u) << "three scenes and the pattern";
  EXPECT_THAT(
      red_sentences(checks),
      testing::ElementsAre(testing::AllOf(
          testing::StartsWith("R: matches nothing: no row of the rule has a detector \"ex?ct2\"; "
                              "the results have the detectors \"exact\""),
          testing::Not(testing::HasSubstr("scenes")))));
}

TEST(PatternWithAnExclamationMark, TakesRowsOutAndNeedNotMatch) {
  const auto checks = checks_of(
      "'scenes': ['touch'], 'detectors': ['*', '!broken', '!l?st', '!nobody'], "
      "'measure': 'status', 'equals': 'ok'",
      sample_results());
  ASSERT_EQ(checks.size(), 4u);
  for (const Check& check : checks) EXPECT_EQ(check.verdict, Verdict::kPass) << check.detector;
}

TEST(OracleRuleWithoutRandomPairs, MatchesNothing) {
  EXPECT_THAT(
      red_sentences(checks_of("'scenes': ['touch'], 'measure': 'oracle_wrong', 'at_most': 0",
                              sample_results())),
      testing::ElementsAre(testing::StartsWith(
          "R: matches nothing: no row has a scene of \"touch\"; the results have the scenes ")));
}

// Of three rules, one cannot judge a row: "single" has no stages.
GateResult result_with_open_rule(std::optional<std::size_t> allowed) {
  Policy policy = test::policy_of(kHolds);
  policy.rules.push_back(test::policy_of("'scenes': ['touch'], 'detectors': ['single', 'exact'], "
                                         "'measure': 'stage_missed', 'at_most': 9")
                             .rules[0]);
  policy.rules.back().name = "stages";
  policy.cannot_judge_at_most = allowed;
  return run_gate(policy, results::from_json(sample_results()), nullptr);
}

TEST(RulesThatCannotJudge, AreCounted) {
  EXPECT_THAT(counts_text(result_with_open_rule({})),
              testing::EndsWith(" 1 cannot judge (of 1 rule)"));
}

TEST(RulesThatCannotJudge, BreakAPolicyThatAllowsFewer) {
  EXPECT_FALSE(result_with_open_rule({}).red());
  EXPECT_FALSE(result_with_open_rule(1).red());
  EXPECT_THAT(red_sentences(result_with_open_rule(0).checks),
              testing::ElementsAre("rules can judge what they are about: rules that cannot judge "
                                   "1, allowed at most 0; they are \"stages\""));
}

// A detector that had no process of its own: whatever its row says, it is not gated.
TEST(UnisolatedRow, CannotBeJudged) {
  const Json baseline = sample_results();
  Json results = sample_results();
  row_of(results, "touch", "paper") = row_of(results, "touch", "broken");
  results["runs"][2]["detector"] = "paper";
  const auto checks = [&](const char* measure) {
    return checks_of(std::string("'scenes': ['touch'], 'detectors': ['paper'], ") + measure,
                     results, &baseline);
  };
  const auto measures = {"'measure': 'missed', 'at_most': 0", "'measure': 'status', 'equals': 'ok'",
                         "'measure': 'contact_hash', 'unchanged': true"};
  for (const char* measure : measures)
    EXPECT_EQ(red_sentences(checks(measure)).size(), 2u) << measure << " and the row that was lost";
  results["plugins"] = {{{"detector", "paper"},
                         {"kind", "command"},
                         {"source", "it"},
                         {"content", "c"},
                         {"version", ""},
                         {"unisolated", true}}};
  for (const char* measure : measures) {
    const std::vector<Check> judged = checks(measure);
    ASSERT_EQ(judged.size(), 1u) << measure;
    EXPECT_EQ(judged[0].verdict, Verdict::kCannotJudge) << measure;
    EXPECT_THAT(judged[0].reason, testing::StartsWith("unisolated")) << measure;
  }
}

TEST(RuleThatNeedsABaseline, IsRefusedWithoutOne) {
  for (const char* rule :
       {"'measure': 'contact_hash', 'unchanged': true",
        "'measure': 'slowdown', 'question': 'triangles', 'reference': 'ref', 'at_most': 1.1"})
    EXPECT_THROW(checks_of(std::string("'scenes': ['touch'], 'detectors': ['exact'], ") + rule,
                           sample_results()),
                 InputError)
        << rule;
}

TEST(Baseline, OfTheSameRowsIsGreen) {
  const Json baseline = sample_results();
  EXPECT_EQ(red_sentences(checks_of(kHolds, sample_results(), &baseline)).size(), 0u);
}

TEST(Baseline, SceneThatTheResultsLackIsBroken) {
  const Json baseline = sample_results();
  Json results = sample_results();
  results["scenes"].erase(1);
  results["runs"].erase(6);
  ASSERT_EQ(red_sentences(checks_of(kHolds, results)).size(), 0u);
  EXPECT_THAT(red_sentences(checks_of(kHolds, results, &baseline)),
              testing::ElementsAre(std::string(kBaselineRule) +
                                   ": hard-gap: the baseline has this scene, the results do not"));
}

TEST(Baseline, DetectorThatTheResultsLackInASceneIsBroken) {
  const Json baseline = sample_results();
  Json results = sample_results();
  results["runs"].erase(2);
  EXPECT_THAT(red_sentences(checks_of(kHolds, results, &baseline)),
              testing::ElementsAre(std::string(kBaselineRule) +
                                   ": touch  paper: the baseline has this detector in this scene, "
                                   "the results do not"));
}

TEST(Baseline, DetectorThatEndedWellAndNoLongerDoesIsBroken) {
  Json baseline = sample_results();
  const Json well = row_of(baseline, "touch", "paper");
  row_of(baseline, "touch", "broken") = well;
  baseline["runs"][4]["detector"] = "broken";
  const auto checks = checks_of(kHolds, sample_results(), &baseline);
  ASSERT_FALSE(checks.empty());
  EXPECT_EQ(checks.back().scene, "touch");
  EXPECT_EQ(checks.back().detector, "broken");
  EXPECT_EQ(checks.back().frame, "frame 4");
  EXPECT_EQ(checks.back().measured, "status error");
  EXPECT_EQ(checks.back().rerun,
            "contactcheck run scenes/touch.json --frames 8 --detector broken --no-timing");
}

TEST(Baseline, RowThatFailedInItMayFailAgainOrBeNew) {
  const Json baseline = sample_results();  // "broken" failed and "lost" was absent
  Json results = sample_results();
  Json row = row_of(results, "touch", "exact");
  row["detector"] = "new";
  results["runs"].push_back(row);
  EXPECT_EQ(red_sentences(checks_of(kHolds, results, &baseline)).size(), 0u);
}

}  // namespace
}  // namespace contactcheck::gate
