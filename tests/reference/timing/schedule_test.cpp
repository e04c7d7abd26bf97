#include "reference/timing/schedule.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace contactcheck::timing {
namespace {

using testing::ElementsAre;

TEST(ColdFrames, AreEightDifferentOnesInOrder) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const std::vector<std::size_t> frames = draw_cold_frames(std::vector<bool>(60), seed);
    EXPECT_EQ(frames.size(), 8u);
    EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end(), std::less_equal<>())) << seed;
    EXPECT_LT(frames.back(), 60u);
  }
}

TEST(ColdFrames, AreAllWhereThereAreNoMore) {
  EXPECT_THAT(draw_cold_frames(std::vector<bool>(3), 1), ElementsAre(0, 1, 2));
}

TEST(ColdFrames, HoldContactWhereThereIsAny) {
  std::vector<bool> contact(1000);
  contact[617] = true;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_THAT(draw_cold_frames(contact, seed), testing::Contains(617u));
}

TEST(ColdFrames, DifferBySeedAndEveryFrameIsDrawn) {
  std::set<std::size_t> drawn;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (const std::size_t frame : draw_cold_frames(std::vector<bool>(60), seed))
      drawn.insert(frame);
  EXPECT_EQ(drawn.size(), 60u);
}

TEST(TurnOrder, IsAPermutationThatDiffersBySeed) {
  const std::vector<std::size_t> order = draw_order(20, 1);
  std::vector<std::size_t> sorted = order, all(20);
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(sorted, all);
  EXPECT_EQ(order, draw_order(20, 1));
  EXPECT_NE(order, draw_order(20, 2));
}

// Or one detector would always find the caches as the same other one has left them.
TEST(TurnOrder, EveryTurnFollowsEveryOther) {
  std::set<std::pair<std::size_t, std::size_t>> neighbours;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::vector<std::size_t> order = draw_order(4, seed);
    for (std::size_t i = 1; i < order.size(); ++i) neighbours.emplace(order[i - 1], order[i]);
  }
  EXPECT_EQ(neighbours.size(), 12u);
}

}  // namespace
}  // namespace contactcheck::timing
