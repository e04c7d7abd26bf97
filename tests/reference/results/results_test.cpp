#include <gmock/gmock.h>

#include "reference/results/results.h"

namespace contactcheck::results {
namespace {

using testing::Optional;

LevelCounts rated(LevelCounts counts) {
  counts.set_rates();
  return counts;
}

TEST(LevelCounts, RatesOverNothingHaveNoValue) {
  const LevelCounts nothing = rated({});
  EXPECT_EQ(nothing.recall, std::nullopt);
  EXPECT_EQ(nothing.spurious_rate, std::nullopt);
}

TEST(LevelCounts, SpuriousOverReportedExistsWithoutTruth) {
  const LevelCounts only_reported = rated({0, 4, 0, 0, 4});
  EXPECT_EQ(only_reported.recall, std::nullopt);
  EXPECT_THAT(only_reported.spurious_rate, Optional(1.0));
}

TEST(LevelCounts, RecallIsHitOverTruthAndSpuriousIsOverReported) {
  const LevelCounts counts = rated({8, 10, 6, 2, 4});
  EXPECT_THAT(counts.recall, Optional(0.75));
  EXPECT_THAT(counts.spurious_rate, Optional(0.4));
}

TEST(LevelCounts, AddUpFieldByField) {
  LevelCounts sum{1, 2, 3, 4, 5};
  sum += LevelCounts{10, 20, 30, 40, 50};
  EXPECT_EQ(sum.truth, 11u);
  EXPECT_EQ(sum.reported, 22u);
  EXPECT_EQ(sum.hit, 33u);
  EXPECT_EQ(sum.missed, 44u);
  EXPECT_EQ(sum.spurious, 55u);
}

TEST(LevelCounts, PerfectNeedsNeitherMissedNorSpurious) {
  EXPECT_TRUE((LevelCounts{3, 3, 3, 0, 0}.perfect()));
  EXPECT_FALSE((LevelCounts{3, 2, 2, 1, 0}.perfect()));
  EXPECT_FALSE((LevelCounts{3, 4, 3, 0, 1}.perfect()));
}

TEST(Status, NamesAreTheWordsOfTheDesign) {
  EXPECT_STREQ(name_of(Status::kOk), "ok");
  EXPECT_STREQ(name_of(Status::kError), "error");
  EXPECT_STREQ(name_of(Status::kAbsent), "absent");
  EXPECT_STREQ(name_of(Status::kRefused), "refused");
}

TEST(Hex, HasSixteenDigits) {
  EXPECT_EQ(hex(0), "0x0000000000000000");
  EXPECT_EQ(hex(0xfedcba9876543210), "0xfedcba9876543210");
}

}  // namespace
}  // namespace contactcheck::results
