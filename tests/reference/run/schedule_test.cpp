#include "reference/run/schedule.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace contactcheck {
namespace {

using testing::ElementsAre;

std::vector<bool> contact_between(std::size_t frames, std::size_t first, std::size_t last) {
  std::vector<bool> out(frames, false);
  std::fill(out.begin() + static_cast<std::ptrdiff_t>(first),
            out.begin() + static_cast<std::ptrdiff_t>(last), true);
  return out;
}

struct Case {
  std::size_t frames, first, last;
};

class TimingOrder : public testing::TestWithParam<Case> {
 protected:
  std::vector<bool> contact_ =
      contact_between(GetParam().frames, GetParam().first, GetParam().last);
  std::vector<std::size_t> order_ = timing_order(contact_);
};

TEST_P(TimingOrder, IsAPermutation) {
  std::vector<std::size_t> sorted = order_, all(contact_.size());
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
}

TEST_P(TimingOrder, EveryPrefixHoldsItsShareOfContact) {
  const double share = static_cast<double>(GetParam().last - GetParam().first) /
                       static_cast<double>(contact_.size());
  double found = 0.0;
  for (std::size_t k = 1; k <= order_.size(); ++k) {
    found += contact_[order_[k - 1]];
    EXPECT_LE(std::abs(found - share * static_cast<double>(k)), 1.0) << "prefix of " << k;
  }
}

TEST_P(TimingOrder, BeginsWithAContactFrameWhereThereIsOne) {
  const bool has_contact = GetParam().first < GetParam().last;
  EXPECT_EQ(contact_[order_.front()], has_contact);
}

// The largest stretch of frames of one kind without a timed frame, in a prefix of k of that kind.
std::size_t widest_hole(std::vector<std::size_t> ranks, std::size_t count) {
  std::sort(ranks.begin(), ranks.end());
  std::size_t widest = ranks.front(), before = ranks.front();
  for (std::size_t r : ranks) {
    widest = std::max(widest, r - before);
    before = r;
  }
  return std::max(widest, count - before);
}

TEST_P(TimingOrder, EveryPrefixIsSpreadOverContactAndOverFreeFrames) {
  for (bool kind : {true, false}) {
    const auto count = static_cast<std::size_t>(std::count(contact_.begin(), contact_.end(), kind));
    std::vector<std::size_t> ranks;
    for (std::size_t frame : order_) {
      if (contact_[frame] != kind) continue;
      const auto here = contact_.begin() + static_cast<std::ptrdiff_t>(frame);
      ranks.push_back(static_cast<std::size_t>(std::count(contact_.begin(), here, kind)));
      // Van der Corput's order leaves no hole above four times the even spacing.
      EXPECT_LE(widest_hole(ranks, count), 4 * count / ranks.size() + 1) << ranks.size();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TimingOrder,
                         testing::Values(Case{60, 20, 33}, Case{60, 0, 0}, Case{60, 0, 60},
                                         Case{7, 6, 7}, Case{1, 0, 1}, Case{1, 0, 0},
                                         Case{101, 3, 99}, Case{60, 59, 60}));

TEST(TimingOrderLiteral, OfEightFramesWithTwoContacts) {
  // Contact frames 3 and 4; free ones 0 1 2 5 6 7 in bit-reversed order 0 6 2 1 7 5.
  EXPECT_THAT(timing_order(contact_between(8, 3, 5)), ElementsAre(3, 0, 6, 2, 4, 1, 7, 5));
}

TEST(TimingOrderLiteral, OfNothingIsNothing) { EXPECT_TRUE(timing_order({}).empty()); }

TEST(FramesWithinBudget, FitsWholeFrames) {
  EXPECT_EQ(frames_within_budget(1.0, 0.01, 5, 4, 60), 20u);
  EXPECT_EQ(frames_within_budget(1.0, 0.011, 5, 4, 60), 18u);
}

TEST(FramesWithinBudget, NeverMoreThanThereAre) {
  EXPECT_EQ(frames_within_budget(1.0, 1e-6, 5, 4, 60), 60u);
  EXPECT_EQ(frames_within_budget(1.0, 0.0, 5, 4, 60), 60u);
  EXPECT_EQ(frames_within_budget(1.0, 0.5, 5, 4, 3), 3u);
}

TEST(FramesWithinBudget, NeverFewerThanTheFewest) {
  EXPECT_EQ(frames_within_budget(1.0, 0.3, 5, 4, 60), 4u);
  EXPECT_EQ(frames_within_budget(1.0, 0.5, 5, 4, 60), 4u);
}

TEST(FramesWithinBudget, HalfTheFewestWhereTheseTakeTenTimesTheBudget) {
  EXPECT_EQ(frames_within_budget(1.0, 0.6, 5, 4, 60), 2u);
  EXPECT_EQ(frames_within_budget(1.0, 100.0, 5, 4, 60), 2u);
  EXPECT_EQ(frames_within_budget(1.0, 100.0, 5, 1, 60), 1u);
  EXPECT_EQ(frames_within_budget(1.0, 100.0, 5, 4, 1), 1u);
}

}  // namespace
}  // namespace contactcheck
