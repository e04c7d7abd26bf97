// Policies, baselines and flags that gate and accept cannot use: exit code 2 and one sentence.
#include <gmock/gmock.h>

#include "tests/reference/cli/gate_files.h"
#include "tests/reference/cli/refusal.h"

namespace contactcheck::cli {
namespace {

using test::BadCommand;
using test::Scratch;
using test::Words;

class BadGate : public testing::TestWithParam<BadCommand> {};

TEST_P(BadGate, IsRefusedWithOneSentence) {
  const Scratch scratch;
  test::write_gate_files(scratch);
  scratch.write("folder/x", "");
  scratch.write("text.txt", "keep me");
  auto results = test::sample_results();
  results["runs"].clear();
  scratch.write("no-rows.json", results.dump());
  results = test::sample_results();
  results["runs"][2]["levels"]["cell"]["missed"] = -1;
  scratch.write("negative.json", results.dump());
  results = test::sample_results();
  results["schema"] = "contactcheck-results/1";
  scratch.write("earlier.json", results.dump());
  results = test::sample_results();
  results["runs"][0]["time_ms"]["timed_frames"] = 9;
  scratch.write("frames.json", results.dump());
  results = test::sample_results();
  results["runs"][0]["time_ms"]["timed_contact_frames"] = 9;
  scratch.write("contact-frames.json", results.dump());
  results = test::sample_results();
  results["runs"][0]["speedup"]["triangles"]["ref"]["passes"] = 8;
  scratch.write("passes.json", results.dump());
  results = test::sample_results();
  results["runs"][0]["per_frame"]["frame_ms"].erase(0);
  scratch.write("frame-ms.json", results.dump());
  results = test::sample_results();
  results["runs"][0]["time_ms"]["pass_ms"] = {1.0, 1.5};
  scratch.write("pass-ms.json", results.dump());
  results["runs"][0]["time_ms"]["pass_ms"] = {1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0};
  scratch.write("no-time.json", results.dump());
  results["runs"][0]["time_ms"]["pass_ms"] = nlohmann::ordered_json::array();
  scratch.write("no-pass-ms.json", results.dump());
  test::expect_refused(GetParam(), scratch);
}

std::string gate_case(const testing::TestParamInfo<BadCommand>& test) { return test.param.name; }

BadCommand gate_with(const std::string& name, const Words& more, const Words& named) {
  BadCommand command = {name, {"gate", "DIR/results.json"}, named};
  command.words.insert(command.words.end(), more.begin(), more.end());
  return command;
}

INSTANTIATE_TEST_SUITE_P(
    Gate, BadGate,
    testing::Values(
        gate_with("NeitherPolicyNorBaseline", {}, {"--policy", "--baseline"}),
        gate_with("NoBaselineForARuleThatNeedsOne", {"--policy", "DIR/policy.json"},
                  {"policy \"own\"", "rule \"same contacts\"", "--baseline"}),
        gate_with("PolicyThatIsNotThere", {"--policy", "DIR/none.json"}, {"DIR/none.json"}),
        gate_with("PolicyThatIsAFolder", {"--policy", "DIR/folder"}, {"DIR/folder", "folder"}),
        gate_with("PolicyThatIsAResultsFile", {"--policy", "DIR/results.json"},
                  {"DIR/results.json", "is not a known key", "schema, id, title, rules"}),
        gate_with("PolicyTwice", {"--policy", "DIR/policy.json", "--policy", "DIR/policy.json"},
                  {"--policy"}),
        gate_with("BaselineThatIsNotThere",
                  {"--policy", "DIR/policy.json", "--baseline", "DIR/none.json"},
                  {"DIR/none.json"}),
        gate_with("BaselineThatIsAPolicy",
                  {"--policy", "DIR/policy.json", "--baseline", "DIR/policy.json"},
                  {"DIR/policy.json", "field schema is not \"contactcheck-results/2\""}),
        gate_with("BaselineThatBreaksTheSchema",
                  {"--policy", "DIR/policy.json", "--baseline", "DIR/negative.json"},
                  {"DIR/negative.json", "runs[2].levels.cell.missed is -1", "at least 0"}),
        gate_with("BaselineOfAnEarlierVersion",
                  {"--policy", "DIR/policy.json", "--baseline", "DIR/earlier.json"},
                  {"DIR/earlier.json", "field schema is \"contactcheck-results/1\"",
                   "recorded anew with `contactcheck run`"}),
        gate_with("JunitBelowAFile",
                  {"--policy", "DIR/policy.json", "--baseline", "DIR/baseline.json", "--junit",
                   "DIR/text.txt/gate.xml"},
                  {"DIR/text.txt/gate.xml", "Not a directory"}),
        gate_with("JunitOntoAFolder",
                  {"--policy", "DIR/policy.json", "--baseline", "DIR/baseline.json", "--junit",
                   "DIR/folder"},
                  {"DIR/folder"}),
        gate_with("UnknownFlag", {"--policy", "DIR/policy.json", "--strict"}, {"--strict"}),
        BadCommand{"ResultsThatBreakTheSchema",
                   {"gate", "DIR/negative.json", "--policy", "DIR/policy.json"},
                   {"DIR/negative.json", "runs[2].levels.cell.missed is -1"}},
        BadCommand{"ResultsOfAnEarlierVersion",
                   {"gate", "DIR/earlier.json", "--policy", "DIR/policy.json"},
                   {"DIR/earlier.json", "results of an earlier version"}},
        BadCommand{"MoreTimedFramesThanFrames",
                   {"gate", "DIR/frames.json", "--policy", "DIR/policy.json"},
                   {"DIR/frames.json", "runs[0].time_ms.timed_frames is 9", "at most 8"}},
        BadCommand{
            "MoreTimedContactFramesThanTimed",
            {"gate", "DIR/contact-frames.json", "--policy", "DIR/policy.json"},
            {"DIR/contact-frames.json", "runs[0].time_ms.timed_contact_frames is 9", "at most 8"}},
        BadCommand{"MorePassesOfASpeedUpThanOfTheRow",
                   {"gate", "DIR/passes.json", "--policy", "DIR/policy.json"},
                   {"DIR/passes.json", "runs[0].speedup.triangles.ref.passes is 8", "at most 7"}},
        BadCommand{
            "TimesOfOtherFrames",
            {"gate", "DIR/frame-ms.json", "--policy", "DIR/policy.json"},
            {"DIR/frame-ms.json", "runs[0].per_frame.frame_ms has 7 entries", "must have 8"}},
        BadCommand{"TimesOfOtherPasses",
                   {"gate", "DIR/pass-ms.json", "--policy", "DIR/policy.json"},
                   {"DIR/pass-ms.json", "runs[0].time_ms.pass_ms has 2 entries", "must have 7"}},
        BadCommand{"PassThatTookNoTime",
                   {"gate", "DIR/no-time.json", "--policy", "DIR/policy.json"},
                   {"DIR/no-time.json", "runs[0].time_ms.pass_ms[3] is 0", "above 0"}},
        BadCommand{"TimesOfNoPass",
                   {"gate", "DIR/no-pass-ms.json", "--policy", "DIR/policy.json"},
                   {"DIR/no-pass-ms.json", "runs[0].time_ms.pass_ms"}},
        BadCommand{"NoResults", {"gate", "--policy", "DIR/policy.json"}, {"results"}}),
    gate_case);

INSTANTIATE_TEST_SUITE_P(
    Accept, BadGate,
    testing::Values(BadCommand{"NoPlace", {"accept", "DIR/results.json"}, {"--as", "required"}},
                    BadCommand{"NotJson",
                               {"accept", "DIR/results.json", "--as", "DIR/base.txt"},
                               {"--as DIR/base.txt", "ends in .json"}},
                    BadCommand{
                        "InPlaceOfAPolicy",
                        {"accept", "DIR/results.json", "--as", "DIR/policy.json"},
                        {"DIR/policy.json", "field schema is not \"contactcheck-results/2\""}},
                    BadCommand{"FolderThatIsNotThere",
                               {"accept", "DIR/results.json", "--as", "DIR/none/base.json"},
                               {"DIR/none/base.json", "No such file"}},
                    BadCommand{"ResultsWithoutRows",
                               {"accept", "DIR/no-rows.json", "--as", "DIR/base.json"},
                               {"DIR/no-rows.json", "runs is empty"}},
                    BadCommand{"ResultsThatBreakTheSchema",
                               {"accept", "DIR/negative.json", "--as", "DIR/base.json"},
                               {"DIR/negative.json", "runs[2].levels.cell.missed is -1"}},
                    BadCommand{"APolicyAsResults",
                               {"accept", "DIR/policy.json", "--as", "DIR/base.json"},
                               {"DIR/policy.json", "field schema"}}),
    gate_case);

TEST(GithubSummary, ThatCannotBeWrittenIsRefused) {
  const Scratch scratch;
  test::write_gate_files(scratch);
  const test::Environment environment("GITHUB_STEP_SUMMARY", scratch.folder() / "none" / "s.md");
  test::expect_refused({"",
                        {"gate", "DIR/results.json", "--policy", "DIR/policy.json", "--baseline",
                         "DIR/baseline.json", "--github"},
                        {"DIR/none/s.md", "GITHUB_STEP_SUMMARY", "No such file"}},
                       scratch);
}

struct BadText {
  std::string name, text;
  Words named;
};
void PrintTo(const BadText& policy, std::ostream* out) { *out << policy.name; }

class BadPolicy : public testing::TestWithParam<BadText> {};

TEST_P(BadPolicy, IsRefusedWithFilePlaceAndValue) {
  const Scratch scratch;
  test::write_gate_files(scratch);
  scratch.write("bad.json", GetParam().text);
  Words named = GetParam().named;
  named.emplace_back("policy \"DIR/bad.json\"");
  test::expect_refused({"", {"gate", "DIR/results.json", "--policy", "DIR/bad.json"}, named},
                       scratch);
}

// A policy of one rule over everything.
std::string rule(const std::string& rest) {
  return test::policy_text(R"({"rule": "R", "scenes": ["*"], "detectors": ["*"], )" + rest + "}");
}
std::string timing(const std::string& rest) {
  return rule(R"("measure": "speedup", "question": "triangles", "reference": "ref", )" + rest);
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadPolicy,
    testing::Values(
        BadText{"Empty", "", {"is empty"}},
        BadText{"CutShort", R"({"schema": "contactcheck-policy/1", "rules": [)", {"line 1"}},
        BadText{"NoSchema", R"({"id": "a", "title": "b", "rules": []})", {"schema is missing"}},
        BadText{"NextSchema",
                R"({"schema": "contactcheck-policy/2", "id": "a", "title": "b", "rules": []})",
                {"schema is \"contactcheck-policy/2\"", "contactcheck-policy/1"}},
        BadText{"LimitOfOpenRules",
                R"({"schema": "contactcheck-policy/1", "id": "a", "title": "b", "rules": [],)"
                R"( "cannot_judge_at_most": -1})",
                {"cannot_judge_at_most is -1", "0"}},
        BadText{"NoRules", test::policy_text(""), {"rules is an array of 0", "at least 1"}},
        BadText{"RuleAsText", test::policy_text("\"R\""), {"rules[0] is \"R\"", "an object"}},
        BadText{
            "TwoOfOneName",
            test::policy_text(
                R"({"rule": "R", "scenes": ["*"], "detectors": ["*"], "measure": "missed", "at_most": 0},
                       {"rule": "R", "scenes": ["*"], "detectors": ["*"], "measure": "missed", "at_most": 1})"),
            {"rules[1].rule is \"R\"", "different from rules[0].rule"}}),
    [](const testing::TestParamInfo<BadText>& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Rules, BadPolicy,
    testing::Values(
        BadText{"NoMeasure", rule(R"("at_most": 0)"), {"rules[0].measure is missing"}},
        BadText{"UnknownMeasure",
                rule(R"("measure": "misses", "at_most": 0)"),
                {"rules[0].measure is \"misses\"", "missed, spurious"}},
        BadText{"NoName",
                test::policy_text(
                    R"({"scenes": ["*"], "detectors": ["*"], "measure": "missed", "at_most": 0})"),
                {"rules[0].rule is missing"}},
        BadText{"UnknownKey",
                rule(R"("measure": "missed", "atmost": 0)"),
                {"rules[0].atmost is not a known key", "at_most"}},
        BadText{"NoLimit",
                rule(R"("measure": "missed")"),
                {"rules[0] has none of the keys at_most, at_least, unchanged"}},
        BadText{"TwoLimits",
                rule(R"("measure": "missed", "at_most": 0, "unchanged": true)"),
                {"rules[0] has both \"at_most\" and \"unchanged\""}},
        BadText{"NegativeCount",
                rule(R"("measure": "missed", "at_most": -1)"),
                {"rules[0].at_most is -1", "at least 0"}},
        BadText{"RecallInPercent",
                rule(R"("measure": "recall", "at_least": 99)"),
                {"rules[0].at_least is 99", "at most 1"}},
        BadText{"LimitAsText",
                rule(R"("measure": "missed", "at_most": "0")"),
                {"rules[0].at_most is \"0\"", "a number"}},
        BadText{"UnchangedThatIsFalse",
                rule(R"("measure": "missed", "unchanged": false)"),
                {"rules[0].unchanged is false", "true"}},
        BadText{"RoundedThatIsFalse",
                rule(R"("measure": "missed", "at_most": 0, "rounded": false)"),
                {"rules[0].rounded is false", "true"}},
        BadText{"UnknownLevel",
                rule(R"("measure": "missed", "level": "pixel", "at_most": 0)"),
                {"rules[0].level is \"pixel\"", "triangle"}},
        BadText{"LevelOfAMeasureWithoutOne",
                rule(R"("measure": "memory_bytes", "level": "cell", "at_most": 0)"),
                {"rules[0].level is not a known key"}},
        BadText{"NoScenes",
                test::policy_text(
                    R"({"rule": "R", "detectors": ["*"], "measure": "missed", "at_most": 0})"),
                {"rules[0].scenes is missing"}},
        BadText{
            "EmptyDetectors",
            test::policy_text(
                R"({"rule": "R", "scenes": ["*"], "detectors": [], "measure": "missed", "at_most": 0})"),
            {"rules[0].detectors is an array of 0"}},
        BadText{
            "OnlyExceptions",
            test::policy_text(
                R"({"rule": "R", "scenes": ["!a"], "detectors": ["*"], "measure": "missed", "at_most": 0})"),
            {"rules[0].scenes has no pattern without \"!\""}},
        BadText{
            "ExclamationMarkAlone",
            test::policy_text(
                R"({"rule": "R", "scenes": ["*", "!"], "detectors": ["*"], "measure": "missed", "at_most": 0})"),
            {"rules[0].scenes[1] is \"!\""}},
        BadText{"HashEqualToANumber",
                rule(R"("measure": "contact_hash", "equals": "0xa")"),
                {"rules[0].equals is \"0xa\"", "truth"}},
        BadText{"HashAtMost",
                rule(R"("measure": "contact_hash", "at_most": 0)"),
                {"rules[0].at_most is not a known key", "unchanged, equals"}},
        BadText{"StatusOfAnother",
                rule(R"("measure": "status", "equals": "error")"),
                {"rules[0].equals is \"error\"", "ok"}},
        BadText{"OracleWithDetectors",
                rule(R"("measure": "oracle_wrong", "at_most": 0)"),
                {"rules[0].detectors is not a known key"}},
        BadText{"Noisy",
                rule(R"("measure": "missed", "at_most": 0, "noisy": "fail")"),
                {"rules[0].noisy is not a known key"}},
        BadText{"Unjudged",
                rule(R"("measure": "missed", "at_most": 0, "unjudged": "red")"),
                {"rules[0].unjudged is \"red\"", "pass, fail"}}),
    [](const testing::TestParamInfo<BadText>& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    TimingRules, BadPolicy,
    testing::Values(
        BadText{"NoQuestion",
                rule(R"("measure": "speedup", "reference": "ref", "at_least": 2)"),
                {"rules[0].question is missing"}},
        BadText{"NoReference",
                rule(R"("measure": "speedup", "question": "body", "at_least": 2)"),
                {"rules[0].reference is missing"}},
        BadText{"SpeedupWindowReversed",
                timing(R"("at_least": 3, "at_most": 2)"),
                {"rules[0].at_most is 2; it must be above at_least, which is 3"}},
        BadText{"RefusedAsAWord",
                timing(R"("at_least": 2, "refused": "maybe")"),
                {"rules[0].refused is \"maybe\"", "pass, fail"}},
        BadText{"LimitOfZero", timing(R"("at_least": 0)"), {"rules[0].at_least is 0", "above 0"}},
        BadText{"UnknownPart",
                timing(R"("at_least": 2, "part": "warm")"),
                {"rules[0].part is \"warm\"", "playback, cold"}},
        BadText{"RegimeOfEarlierVersions",
                timing(R"("at_least": 2, "part": "hot")"),
                {"rules[0].part is \"hot\"", "playback, cold, contact_frames, without_map"}},
        BadText{"NegativeFloor",
                timing(R"("at_least": 2, "floor_us": -1)"),
                {"rules[0].floor_us is -1"}},
        BadText{"NoiseWidthInPercent",
                timing(R"("at_least": 2, "noise_width": 20)"),
                {"rules[0].noise_width is 20", "at most 10"}},
        BadText{"NoisyPerhaps",
                timing(R"("at_least": 2, "noisy": "perhaps")"),
                {"rules[0].noisy is \"perhaps\"", "pass, fail"}}),
    [](const testing::TestParamInfo<BadText>& test) { return test.param.name; });

}  // namespace
}  // namespace contactcheck::cli
