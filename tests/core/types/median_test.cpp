#include "core/types/median.h"

#include <gtest/gtest.h>

namespace contactcheck {
namespace {

TEST(Median, OfOddEvenAndSingle) {
  EXPECT_EQ(median({5.0}), 5.0);
  EXPECT_EQ(median({9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(median({8.0, 2.0, 4.0, 100.0}), 6.0);
  EXPECT_EQ(median({3.0, 3.0, 1.0, 3.0}), 3.0);
}

}  // namespace
}  // namespace contactcheck
