// Timing rules on results written by hand.
#include <gmock/gmock.h>

#include "reference/gate/timing_rule.h"
#include "tests/reference/gate/gate_world.h"

namespace contactcheck::gate {
namespace {

using Json = nlohmann::ordered_json;
using test::check_of;
using test::row_of;
using test::sample_results;
using testing::HasSubstr;

std::string speedup(const std::string& limit, const std::string& more = "") {
  return "'measure': 'speedup', 'question': 'triangles', 'reference': 'ref', 'at_least': " + limit +
         more;
}

std::string slowdown(const std::string& limit, const std::string& more = "") {
  return "'measure': 'slowdown', 'question': 'triangles', 'reference': 'ref', 'at_most': " + limit +
         more;
}

Json& ratio_of(Json& results, const char* part = "playback") {
  return row_of(results, "touch", "exact")["speedup"]["triangles"]["ref"][part];
}

// The detector takes `factor` times as long as in the sample.
Json slower(double factor) {
  Json results = sample_results();
  Json& ratio = ratio_of(results);
  for (const char* key : {"ratio", "low", "high"}) ratio[key] = ratio[key].get<double>() / factor;
  Json& frame = row_of(results, "touch", "exact")["time_ms"]["playback"]["frame"];
  frame = frame.get<double>() * factor;
  return results;
}

TEST(Speedup, ReachedPasses) {
  const Check check = check_of("exact", speedup("3.8"), sample_results());
  EXPECT_EQ(check.verdict, Verdict::kPass);
  EXPECT_EQ(check.measured, "speedup 4.00x [3.80, 4.20] over ref, triangles, playback");
  EXPECT_EQ(check.allowed, "at least 3.8x");
}

TEST(Speedup, MissedByTheWholeIntervalFailsWithItsCommand) {
  const Check check = check_of("exact", speedup("5"), sample_results());
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_TRUE(check.red);
  EXPECT_EQ(check.reason, "200 us too long per frame of 1000 us");
  EXPECT_EQ(check.rerun,
            "contactcheck run scenes/touch.json --frames 8 --detector exact --detector ref "
            "--processes 7");
}

TEST(Speedup, MissedByLessThanTheFloorPasses) {
  EXPECT_EQ(check_of("exact", speedup("5", ", 'floor_us': 201"), sample_results()).verdict,
            Verdict::kPass);
  EXPECT_EQ(check_of("exact", speedup("5", ", 'floor_us': 199"), sample_results()).verdict,
            Verdict::kFail);
}

TEST(Speedup, WithTheLimitInItsIntervalIsTooNoisyAsTheRuleHasIt) {
  const Check check = check_of("exact", speedup("4", ", 'noise_width': 0.05"), sample_results());
  EXPECT_EQ(check.verdict, Verdict::kTooNoisy);
  EXPECT_FALSE(check.red);
  EXPECT_TRUE(
      check_of("exact", speedup("4", ", 'noise_width': 0.05, 'noisy': 'fail'"), sample_results())
          .red);
  EXPECT_EQ(check_of("exact", speedup("4", ", 'noise_width': 0.2"), sample_results()).verdict,
            Verdict::kPass);
}

TEST(Speedup, IsOfThePartThatTheRuleNames) {
  for (const auto& [part, good, bad, us] : {std::tuple{"cold", "1.8", "2.3", "4000"},
                                            {"contact_frames", "2.9", "3.2", "2000"},
                                            {"without_map", "4.9", "5.2", "900"}}) {
    const std::string named = std::string(", 'part': '") + part + "'";
    EXPECT_EQ(check_of("exact", speedup(good, named), sample_results()).verdict, Verdict::kPass);
    const Check check = check_of("exact", speedup(bad, named), sample_results());
    EXPECT_EQ(check.verdict, Verdict::kFail) << part;
    EXPECT_THAT(check.reason, HasSubstr(std::string("per frame of ") + us + " us"));
  }
}

TEST(Speedup, OfAnotherQuestionTakesItsOwnTimes) {
  Json results = sample_results();
  Json& row = row_of(results, "touch", "exact");
  row["speedup"]["body"] = row["speedup"]["triangles"];
  const std::string rule =
      "'measure': 'speedup', 'question': 'body', 'reference': 'ref', 'at_least': 5";
  EXPECT_EQ(check_of("exact", rule, results).reason, "no times per frame of the question body");
  Json times = row["time_ms"];
  times["question"] = "body";
  times["playback"]["frame"] = 0.01;
  row["time_ms_other_questions"] = {times};
  EXPECT_EQ(check_of("exact", rule, results).reason,
            "beyond the limit by 2 us per frame, less than 2 us");
}

TEST(Speedup, ThatIsNotThereCannotBeJudged) {
  Json results = sample_results();
  EXPECT_EQ(check_of("paper", speedup("1"), results).reason, "the run was not timed");
  EXPECT_EQ(check_of("exact",
                     "'measure': 'speedup', 'question': 'triangles', 'reference': 'embree', "
                     "'at_least': 1",
                     results)
                .reason,
            "no speed-up over embree in the question triangles");
  ratio_of(results, "without_map") = nullptr;
  ratio_of(results, "contact_frames") = nullptr;
  ratio_of(results, "cold") = nullptr;
  EXPECT_EQ(check_of("exact", speedup("1", ", 'part': 'cold'"), results).reason,
            "no cold times: triangles is not the own question of both detectors");
  EXPECT_THAT(check_of("exact", speedup("1", ", 'part': 'without_map'"), results).reason,
              HasSubstr("maps lazily"));
  EXPECT_EQ(check_of("exact", speedup("1", ", 'part': 'contact_frames'"), results).reason,
            "no frame with contact was timed");
}

// The row's ratio over the reference is 4.00x [3.80, 4.20] of 7 passes.
Check window(const std::string& bounds, const Json& results = sample_results()) {
  return check_of("exact",
                  "'measure': 'speedup', 'question': 'triangles', 'reference': 'ref', " + bounds,
                  results);
}

TEST(SpeedupWindow, BelowItsUpperEndPasses) {
  const Check check = window("'at_most': 4.2");
  EXPECT_EQ(check.verdict, Verdict::kPass);
  EXPECT_EQ(check.allowed, "at most 4.2x");
}

TEST(SpeedupWindow, AboveItsUpperEndBlamesTheReference) {
  const Check check = window("'at_most': 2");
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_TRUE(check.red);
  EXPECT_EQ(check.measured, "speedup 4.00x [3.80, 4.20] over ref, triangles, playback");
  EXPECT_EQ(check.reason, "ref: 2000 us too long per frame of 4000 us");
  EXPECT_EQ(window("'at_most': 2, 'floor_us': 2001").verdict, Verdict::kPass)
      << "the excess is the reference's";
}

TEST(SpeedupWindow, OfBothEndsFailsOnEither) {
  const Check inside = window("'at_least': 2, 'at_most': 8");
  EXPECT_EQ(inside.verdict, Verdict::kPass);
  EXPECT_EQ(inside.allowed, "at least 2x and at most 8x");
  const Check below = window("'at_least': 5, 'at_most': 8");
  EXPECT_EQ(below.verdict, Verdict::kFail);
  EXPECT_EQ(below.reason, "200 us too long per frame of 1000 us");
  const Check above = window("'at_least': 1, 'at_most': 2");
  EXPECT_EQ(above.verdict, Verdict::kFail);
  EXPECT_EQ(above.allowed, "at least 1x and at most 2x");
  EXPECT_EQ(above.reason, "ref: 2000 us too long per frame of 4000 us");
}

TEST(SpeedupWindow, WithAnEndInAWideIntervalIsTooNoisy) {
  for (const char* bounds :
       {"'at_most': 4", "'at_least': 1, 'at_most': 4", "'at_least': 4, 'at_most': 9"}) {
    const std::string narrow = ", 'noise_width': 0.05";
    EXPECT_EQ(window(bounds + narrow).verdict, Verdict::kTooNoisy) << bounds;
    EXPECT_FALSE(window(bounds + narrow).red);
    EXPECT_TRUE(window(bounds + narrow + ", 'noisy': 'fail'").red);
    EXPECT_EQ(window(bounds + std::string(", 'noise_width': 0.2")).verdict, Verdict::kPass);
  }
}

// A window narrower than the noise: what one end leaves open, the other still finds.
TEST(SpeedupWindow, FailsWhereOneEndIsOpenAndTheOtherBroken) {
  Json results = sample_results();
  ratio_of(results) = {{"ratio", 4.0}, {"low", 2.0}, {"high", 8.0}};
  EXPECT_EQ(window("'at_least': 3, 'at_most': 5", results).verdict, Verdict::kTooNoisy);
  EXPECT_EQ(window("'at_least': 1, 'at_most': 1.9", results).verdict, Verdict::kFail);
  EXPECT_EQ(window("'at_least': 8.1, 'at_most': 9", results).verdict, Verdict::kFail);
}

TEST(SpeedupWindow, OfFewPassesIsJudgedByTheFactorOnEitherSide) {
  Json results = sample_results();
  row_of(results, "touch", "exact")["speedup"]["triangles"]["ref"]["passes"] = 3;
  EXPECT_EQ(window("'at_least': 2.5, 'at_most': 6.5", results).verdict, Verdict::kPass);
  for (const char* open : {"'at_least': 2.6, 'at_most': 99", "'at_least': 1, 'at_most': 6.2",
                           "'at_most': 6.2", "'at_most': 2.6"}) {
    const Check check = window(open, results);
    EXPECT_EQ(check.verdict, Verdict::kCannotJudge) << open;
    EXPECT_THAT(check.reason, HasSubstr("3 passes: the limit lies within a factor 1.5 of the "
                                        "range 3.8x to 4.2x; --processes 5 gives an interval"));
  }
  for (const char* broken :
       {"'at_most': 2.5", "'at_least': 1, 'at_most': 2.5", "'at_least': 6.4, 'at_most': 9"})
    EXPECT_EQ(window(broken, results).verdict, Verdict::kFail) << broken;
}

TEST(SpeedupWindow, OfAReferenceThirtyTimesSlowerIsRed) {
  Json results = sample_results();
  ratio_of(results) = {{"ratio", 120.0}, {"low", 60.0}, {"high", 240.0}};
  EXPECT_TRUE(window("'at_least': 1, 'at_most': 9", results).red);
}

TEST(Slowdown, OfThirtyPercentFails) {
  const Json baseline = sample_results();
  const Check check = check_of("exact", slowdown("1.1"), slower(1.3), &baseline);
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_TRUE(check.red);
  EXPECT_EQ(check.measured,
            "slowdown 1.30x [1.21, 1.40] (speed-up 3.077x, in the baseline 4x, over ref, "
            "triangles, playback)");
  EXPECT_EQ(check.allowed, "at most 1.1x");
  EXPECT_EQ(check.reason, "200 us too long per frame of 1300 us");
}

TEST(Slowdown, OfNothingPasses) {
  const Json baseline = sample_results();
  EXPECT_EQ(check_of("exact", slowdown("1.1"), sample_results(), &baseline).verdict,
            Verdict::kPass);
  EXPECT_EQ(check_of("exact", slowdown("1.1"), slower(0.5), &baseline).verdict, Verdict::kPass)
      << "faster is no change for the worse";
}

TEST(Slowdown, CloseToTheLimitIsTooNoisy) {
  const Json baseline = sample_results();
  EXPECT_EQ(check_of("exact", slowdown("1.1"), slower(1.1), &baseline).verdict, Verdict::kTooNoisy);
}

struct Elsewhere {
  std::string pointer;
  Json value;
  std::string reason;
};

TEST(Slowdown, AgainstAnotherMachineCannotBeJudged) {
  for (const Elsewhere& e :
       {Elsewhere{"/machine/cpu", "B CPU", "cpu is \"A CPU\" here and \"B CPU\" in the baseline"},
        {"/machine/cores", 64, "cores is 2 here and 64 in the baseline"},
        {"/machine/isa", "SSE4", "isa is \"AVX2\" here and \"SSE4\""},
        {"/machine/compiler", "clang 16", "compiler is \"g++ 12\" here and \"clang 16\""},
        {"/machine/build", "Debug", "build is \"Release\" here and \"Debug\""},
        {"/libraries/fcl", "0.8.0", "library fcl is \"0.7.0\" here and \"0.8.0\""},
        {"/libraries/embree", "3.13.5", "library embree is null here and \"3.13.5\""}}) {
    Json baseline = sample_results();
    baseline[Json::json_pointer(e.pointer)] = e.value;
    const Check check = check_of("exact", slowdown("1.1"), slower(1.3), &baseline);
    EXPECT_EQ(check.verdict, Verdict::kCannotJudge) << e.pointer;
    EXPECT_FALSE(check.red);
    EXPECT_THAT(check.reason, HasSubstr("another machine or build: " + e.reason));
    // What does not depend on the machine is judged all the same.
    EXPECT_EQ(check_of("exact", "'measure': 'contact_hash', 'unchanged': true", sample_results(),
                       &baseline)
                  .verdict,
              Verdict::kPass);
  }
}

TEST(Slowdown, OnAnotherOperatingSystemOfTheSameMachineIsJudged) {
  Json baseline = sample_results();
  baseline["machine"]["os"] = "Debian 13";
  EXPECT_EQ(check_of("exact", slowdown("1.1"), slower(1.3), &baseline).verdict, Verdict::kFail);
}

TEST(Slowdown, OfAnotherMeasurementCannotBeJudged) {
  for (const Elsewhere& e :
       {Elsewhere{"/runs/0/frames", 4, "frames is 8 here and 4 in the baseline"},
        {"/runs/0/contact_frames", 2, "contact_frames is 3 here and 2 in the baseline"},
        {"/runs/0/time_ms/timed_frames", 6, "8 frames are timed here and 6 in the baseline"},
        {"/runs/0/speedup/triangles/ref/reference_options",
         {{"bounds", "safe"}},
         "the reference has other options in the baseline"},
        {"/runs/0/speedup/triangles/ref/playback/low", 0, "a speed-up of 0 has no logarithm"},
        {"/runs/0/speedup/triangles", Json::object(),
         "in the baseline: no speed-up over ref in the question triangles"}}) {
    Json baseline = sample_results();
    baseline[Json::json_pointer(e.pointer)] = e.value;
    const Check check = check_of("exact", slowdown("1.1"), slower(1.3), &baseline);
    EXPECT_EQ(check.verdict, Verdict::kCannotJudge) << e.pointer;
    EXPECT_EQ(check.reason, e.reason);
  }
}

TEST(Slowdown, OfOtherColdFramesCannotBeJudged) {
  Json baseline = sample_results();
  EXPECT_EQ(
      check_of("exact", slowdown("1.5", ", 'part': 'cold'"), sample_results(), &baseline).verdict,
      Verdict::kPass);
  baseline["scenes"][0]["cold_frames"] = {1, 3, 4, 7};
  const Check check =
      check_of("exact", slowdown("1.5", ", 'part': 'cold'"), sample_results(), &baseline);
  EXPECT_EQ(check.verdict, Verdict::kCannotJudge);
  EXPECT_EQ(check.reason, "other frames are timed cold in the baseline");
  EXPECT_EQ(check_of("exact", slowdown("1.5"), sample_results(), &baseline).verdict, Verdict::kPass)
      << "a playback has all frames";
}

// As if so many passes had been timed.
Json with_passes(Json results, int passes) {
  Json& row = row_of(results, "touch", "exact");
  row["time_ms"]["passes"] = row["speedup"]["triangles"]["ref"]["passes"] = passes;
  results["timing"]["processes"] = passes;
  return results;
}

TEST(FewPasses, DecideASpeedupBeyondAFactorAlone) {
  const Json results = with_passes(sample_results(), 3);  // 3.8 to 4.2
  const auto verdict = [&](const char* limit) {
    return check_of("exact", speedup(limit), results).verdict;
  };
  EXPECT_EQ(verdict("2.5"), Verdict::kPass);
  EXPECT_EQ(verdict("2.6"), Verdict::kCannotJudge);
  EXPECT_EQ(verdict("6.2"), Verdict::kCannotJudge);
  EXPECT_EQ(verdict("6.4"), Verdict::kFail);
}

TEST(FewPasses, ThatDecideNothingSayWhatWould) {
  const Check check = check_of("exact", speedup("3"), with_passes(sample_results(), 3));
  EXPECT_EQ(check.measured, "speedup 4.00x (range 3.80 to 4.20) over ref, triangles, playback");
  EXPECT_EQ(check.reason,
            "8 frames, 3 passes: the limit lies within a factor 1.5 of the range 3.8x to 4.2x; "
            "--processes 5 gives an interval");
  EXPECT_THAT(check.rerun, testing::EndsWith(" --detector exact --detector ref --processes 5"));
  EXPECT_FALSE(check.red);
  EXPECT_TRUE(
      check_of("exact", speedup("3", ", 'unjudged': 'fail'"), with_passes(sample_results(), 3))
          .red);
}

TEST(FewPasses, AreOfTheFramesOfTheRulesPart) {
  const Json results = with_passes(sample_results(), 3);
  EXPECT_THAT(check_of("exact", speedup("2", ", 'part': 'cold'"), results).reason,
              testing::StartsWith("4 frames, 3 passes: "));
  EXPECT_THAT(check_of("exact", speedup("3", ", 'part': 'contact_frames'"), results).reason,
              testing::StartsWith("3 frames, 3 passes: "));
}

TEST(OnePass, HasNoRange) {
  Json results = with_passes(sample_results(), 1);
  ratio_of(results) = {{"ratio", 4}, {"low", 4}, {"high", 4}};
  const Check check = check_of("exact", speedup("3"), results);
  EXPECT_EQ(check.measured, "speedup 4.00x (1 pass) over ref, triangles, playback");
  EXPECT_EQ(check.reason,
            "8 frames, 1 pass: the limit lies within a factor 1.5 of 4x; --processes 5 gives an "
            "interval");
}

TEST(FewPasses, OfEitherSideMakeASlowdownARange) {
  const Json many = sample_results(), few = with_passes(sample_results(), 3);
  const Check then = check_of("exact", slowdown("1.1"), slower(1.3), &few);
  EXPECT_EQ(then.verdict, Verdict::kCannotJudge);
  EXPECT_EQ(
      then.reason,
      "8 frames, 7 passes, 3 in the baseline: the limit lies within a factor 1.5 of the range "
      "1.18x to 1.44x; --processes 5 in the baseline gives an interval");
  const Check now = check_of("exact", slowdown("1.1"), with_passes(slower(1.3), 3), &many);
  EXPECT_THAT(now.reason, testing::EndsWith("; --processes 5 gives an interval"));
  const Check both = check_of("exact", slowdown("1.1"), with_passes(slower(1.3), 3), &few);
  EXPECT_THAT(both.reason,
              testing::EndsWith("; --processes 5 here and in the baseline gives an interval"));
  EXPECT_EQ(check_of("exact", slowdown("1.1"), with_passes(slower(2.0), 3), &few).verdict,
            Verdict::kFail);
}

}  // namespace
}  // namespace contactcheck::gate
