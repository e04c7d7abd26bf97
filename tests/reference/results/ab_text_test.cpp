#include "reference/results/ab.h"

#include <gmock/gmock.h>

#include "tests/reference/results/rounds.h"

namespace contactcheck::results {
namespace {

using test::steady_rounds;
using test::timed_run;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

AbSetting setting() {
  AbSetting s;
  s.base = "old/contactcheck";
  s.head = "new/contactcheck";
  s.rounds = 7;
  return s;
}

constexpr const char* kHeading =
    "base  old/contactcheck\nhead  new/contactcheck\n"
    "7 rounds in turns; time(head) / time(base), geometric mean and 95 % interval over rounds; "
    "allowed 1.10x, or 20 us a frame\n\n";

TEST(AbText, PassIsTheHeadingAndOneLine) {
  EXPECT_EQ(ab_text(judge_ab(steady_rounds(1.0, 1.0), {}), setting()),
            std::string(kHeading) + "PASS: answers are equal, 1 time is within the limit.\n");
}

TEST(AbText, SlowerDetectorIsNamedWithItsTimes) {
  const AbJudgement judgement = judge_ab(steady_rounds(1.0, 1.3), {});
  EXPECT_EQ(ab_text(judgement, setting()),
            std::string(kHeading) +
                "Slower than 1.10x (1)\n  s  d  1.30x [1.30, 1.30], 1 -> 1.3 ms a frame\n"
                "FAIL: answers are equal, 1 time is too slow.\n");
  EXPECT_TRUE(setting().fails(judgement));
  EXPECT_THAT(ab_failures(judgement, setting()),
              ElementsAre("slower than 1.10x: s  d  1.30x [1.30, 1.30], 1 -> 1.3 ms a frame"));
}

TEST(AbText, OtherAnswersFailUnlessTheyMay) {
  auto rounds = steady_rounds(1.0, 1.0);
  for (AbRound& round : rounds) round.head.runs[0].levels[Level::kTriangle].missed = 1;
  const AbJudgement judgement = judge_ab(rounds, {});
  const std::string line = "  s  d  triangle missed 0 -> 1\n";
  EXPECT_THAT(ab_text(judgement, setting()),
              HasSubstr("Worse answers, base -> head (1)\n" + line +
                        "FAIL: 1 answer is worse, 1 time is within the limit. "
                        "--accuracy-may-change allows it.\n"));
  EXPECT_THAT(ab_failures(judgement, setting()),
              ElementsAre("worse answers than base: s  d  triangle missed 0 -> 1"));
  AbSetting lenient = setting();
  lenient.accuracy_may_change = true;
  EXPECT_THAT(ab_text(judgement, lenient),
              HasSubstr("Worse answers, base -> head (allowed) (1)\n" + line +
                        "PASS: 1 answer is worse, 1 time is within the limit.\n"));
  EXPECT_THAT(ab_failures(judgement, lenient), IsEmpty());
}

TEST(AbText, BetterAnswersAreToldFromWorse) {
  auto rounds = steady_rounds(1.0, 1.0);
  for (AbRound& round : rounds) {
    round.base.runs[0].levels[Level::kTriangle].missed = 7;
    for (results::Results* side : {&round.base, &round.head}) {
      side->runs.push_back(timed_run("s", "e", 1.0));
      side->runs.back().contact_hash = side == &round.base ? "0x1" : "0x2";
    }
  }
  const AbJudgement judgement = judge_ab(rounds, {});
  const std::string text = ab_text(judgement, setting());
  EXPECT_THAT(text,
              HasSubstr("Better answers, base -> head (1)\n  s  d  triangle missed 7 -> 0\n"));
  EXPECT_THAT(text,
              HasSubstr("Other answers, base -> head (1)\n  s  e  contact hash 0x1 -> 0x2\n"));
  EXPECT_THAT(text, HasSubstr("FAIL: 1 answer is better, 1 answer is another, 2 times are within "
                              "the limit. --accuracy-may-change"));
  EXPECT_THAT(ab_failures(judgement, setting()),
              ElementsAre("better answers than base: s  d  triangle missed 7 -> 0",
                          "other answers than base: s  e  contact hash 0x1 -> 0x2"));
}

TEST(AbText, NothingToCompareIsNoPass) {
  auto rounds = steady_rounds(1.0, 1.0);
  for (AbRound& round : rounds) round.head.runs[0].detector = "other";
  const AbJudgement judgement = judge_ab(rounds, {});
  EXPECT_THAT(ab_text(judgement, setting()),
              HasSubstr("Only in base (1)\n  detector d (in 1 scene)\n"
                        "Only in head (1)\n  detector other (in 1 scene)\n"
                        "Nothing was timed in every round of both.\nFAIL: nothing was timed.\n"));
  EXPECT_EQ(ab_failures(judgement, setting()).size(), 1u);
}

TEST(AbText, FasterAndTooNoisyHaveTheirLines) {
  auto rounds = test::rounds_of({1, 1, 1, 1, 1, 1, 1}, {0.7, 0.8, 0.9, 1.2, 1.5, 1.6, 1.7});
  for (AbRound& round : rounds) {
    round.base.runs.push_back(timed_run("s", "e", 2.0));
    round.head.runs.push_back(timed_run("s", "e", 1.0));
  }
  const std::string text = ab_text(judge_ab(rounds, {}), setting());
  EXPECT_THAT(text, HasSubstr("Too noisy to judge: more rounds or a quieter machine would tell (1)"
                              "\n  s  d  1.14x ["));
  EXPECT_THAT(text,
              HasSubstr("Faster (1)\n  s  e  0.500x [0.500, 0.500], 2 -> 1 ms a frame\n"
                        "PASS: answers are equal, 1 time is too noisy to judge, 1 time is within "
                        "the limit.\n"));
}

TEST(AbMarkdown, HasAllTimesAndEscapesNames) {
  auto rounds = steady_rounds(1.0, 1.3);
  for (AbRound& round : rounds)
    for (results::Results* side : {&round.base, &round.head}) side->runs[0].scene = "a|b*";
  const std::string text = ab_markdown(judge_ab(rounds, {}), setting());
  EXPECT_THAT(text, testing::StartsWith(
                        "## contactcheck ab\n\nFAIL: answers are equal, 1 time is too slow."));
  EXPECT_THAT(text, HasSubstr("\n### Slower than 1.10x (1)\n\n- a\\|b\\*  d  1.30x"));
  EXPECT_THAT(text, HasSubstr("\n| a\\|b\\* | d | 1.30 | 1.30 to 1.30 | 1 | 1.3 | **slower** |\n"));
}

}  // namespace
}  // namespace contactcheck::results
