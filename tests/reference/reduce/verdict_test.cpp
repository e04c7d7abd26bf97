#include "reference/reduce/verdict.h"

#include <gmock/gmock.h>

namespace contactcheck::reduce {
namespace {

judge::Disagreement disagreement(const std::string& level, const std::string& kind) {
  judge::Disagreement d;
  d.level = level;
  d.kind = kind;
  d.pair = {0, 1, 5, 17};
  return d;
}

ProbeVerdict missed_and_spurious() {
  ProbeVerdict v;
  v.levels[Level::kTriangle] = {9, 8, 7, 2, 1};
  v.not_judged[Level::kVertex] = "not judged: open";
  v.missed_length = 0.1;
  v.disagreements = {disagreement("body", "spurious"), disagreement("triangle", "missed"),
                     disagreement("triangle", "spurious")};
  return v;
}

TEST(ProbeVerdict, ReadsBackFromItsText) {
  const ProbeVerdict v = verdict_from_text(to_text(missed_and_spurious()));
  EXPECT_EQ(v.status, results::Status::kOk);
  EXPECT_EQ(v.levels.at(Level::kTriangle).missed, 2u);
  EXPECT_EQ(v.levels.at(Level::kTriangle).truth, 9u);
  EXPECT_EQ(v.not_judged.at(Level::kVertex), "not judged: open");
  EXPECT_EQ(v.missed_length, 0.1);
  ASSERT_EQ(v.disagreements.size(), 3u);
  EXPECT_EQ(v.disagreements[1].pair, (ElementPair{0, 1, 5, 17}));
  EXPECT_EQ(v.disagreements[1].kind, "missed");
}

TEST(ProbeVerdict, OfAnErrorKeepsTextThatIsNoUtf8) {
  ProbeVerdict v;
  v.status = results::Status::kError;
  v.how = "threw";
  v.message = "caf\xe9";
  const ProbeVerdict again = verdict_from_text(to_text(v));
  EXPECT_EQ(again.status, results::Status::kError);
  EXPECT_EQ(again.how, "threw");
  EXPECT_EQ(again.message.substr(0, 3), "caf");
}

TEST(ProbeVerdict, RefusesTextOfAnotherKind) {
  EXPECT_THROW(verdict_from_text("hello"), std::runtime_error);
  EXPECT_THROW(verdict_from_text("{}"), std::runtime_error);
}

TEST(FindingOf, TakesTheFinestLevelFirst) {
  const auto finding = finding_of(missed_and_spurious(), "", "");
  ASSERT_TRUE(finding);
  EXPECT_EQ(described(*finding), "missed at level triangle");
  EXPECT_TRUE(finding->crossing);
}

TEST(FindingOf, TakesWhatIsAskedFor) {
  EXPECT_EQ(described(*finding_of(missed_and_spurious(), "body", "")), "spurious at level body");
  EXPECT_EQ(described(*finding_of(missed_and_spurious(), "triangle", "spurious")),
            "spurious at level triangle");
  EXPECT_FALSE(finding_of(missed_and_spurious(), "body", "missed"));
  EXPECT_FALSE(finding_of(missed_and_spurious(), "cell", ""));
  EXPECT_FALSE(finding_of(ProbeVerdict(), "", ""));
}

TEST(FindingOf, AnErrorIsOneUnlessALevelIsAskedFor) {
  ProbeVerdict v;
  v.status = results::Status::kError;
  v.how = "signal 11 (Segmentation fault)";
  EXPECT_EQ(described(*finding_of(v, "", "")), "error: signal 11 (Segmentation fault)");
  EXPECT_FALSE(finding_of(v, "triangle", ""));
  EXPECT_FALSE(finding_of(v, "", "missed"));
}

TEST(Shows, TheSameDefectAndNoOther) {
  ProbeVerdict v = missed_and_spurious();
  const Finding crossing = *finding_of(v, "triangle", "missed");
  EXPECT_TRUE(shows(v, crossing));
  v.missed_length = 0.0;  // what is missed now only touches
  EXPECT_FALSE(shows(v, crossing));
  EXPECT_TRUE(shows(v, Finding{"triangle", "missed"}));
  EXPECT_FALSE(shows(v, Finding{"cell", "missed"}));
}

TEST(Shows, AnErrorOnlyOfTheSameWay) {
  ProbeVerdict v;
  v.status = results::Status::kError;
  v.how = "time limit";
  EXPECT_TRUE(shows(v, Finding{"", "error", "time limit"}));
  EXPECT_FALSE(shows(v, Finding{"", "error", "threw"}));
  EXPECT_FALSE(shows(missed_and_spurious(), Finding{"", "error", "threw"}));
  EXPECT_FALSE(shows(v, Finding{"triangle", "missed"}));
}

}  // namespace
}  // namespace contactcheck::reduce
