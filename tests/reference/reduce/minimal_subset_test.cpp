#include "reference/reduce/reduction.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

namespace contactcheck::reduce {
namespace {

using Items = std::vector<std::size_t>;
using testing::ElementsAre;

Items up_to(std::size_t count) {
  Items out(count);
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

bool always() { return true; }

bool holds(const Items& items, std::size_t item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

TEST(MinimalSubset, OfTwoItemsFarApart) {
  for (const std::size_t count : {2u, 3u, 10u, 1000u}) {
    const std::size_t last = count - 1;
    const auto shows = [&](const Items& items) { return holds(items, 0) && holds(items, last); };
    EXPECT_THAT(minimal_subset(up_to(count), shows, always), ElementsAre(0, last));
  }
}

TEST(MinimalSubset, OfOneItem) {
  const auto shows = [](const Items& items) { return holds(items, 37); };
  EXPECT_THAT(minimal_subset(up_to(100), shows, always), ElementsAre(37));
}

TEST(MinimalSubset, OfAsManyAsItTakes) {
  const auto shows = [](const Items& items) { return items.size() >= 5; };
  EXPECT_EQ(minimal_subset(up_to(64), shows, always).size(), 5u);
}

TEST(MinimalSubset, KeepsAllWhereNoneCanGo) {
  const auto shows = [](const Items& items) { return items.size() == 9; };
  EXPECT_EQ(minimal_subset(up_to(9), shows, always), up_to(9));
}

// Of what comes and goes with the number of items: no single one can be left out of the result.
TEST(MinimalSubset, CannotLoseASingleItem) {
  const auto shows = [](const Items& items) {
    const std::size_t sum = std::accumulate(items.begin(), items.end(), std::size_t{0});
    return items.size() % 3 != 2 && sum % 7 > 2;
  };
  const Items subset = minimal_subset(up_to(41), shows, always);
  ASSERT_TRUE(shows(subset));
  for (const std::size_t left_out : subset) {
    Items fewer = subset;
    std::erase(fewer, left_out);
    EXPECT_TRUE(fewer.empty() || !shows(fewer)) << left_out;
  }
}

TEST(MinimalSubset, StopsWhereItMayNotGoOnWithWhatItHas) {
  int left = 6;
  const auto shows = [&](const Items& items) {
    --left;
    return holds(items, 3) && holds(items, 90);
  };
  const Items subset = minimal_subset(up_to(100), shows, [&] { return left > 0; });
  EXPECT_EQ(left, 0);
  EXPECT_TRUE(holds(subset, 3) && holds(subset, 90));
}

}  // namespace
}  // namespace contactcheck::reduce
