#include "core/types/shortest.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace contactcheck {
namespace {

TEST(Shortest, HasNoMoreDigitsThanItNeeds) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(2.0), "2");
  EXPECT_EQ(shortest(-0.25), "-0.25");
  EXPECT_EQ(shortest(1e30), "1e+30");
}

TEST(Shortest, ReadsBackAsTheSameDouble) {
  for (const double value : {1.0 / 3.0, 0.1 + 0.2, std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::denorm_min()})
    EXPECT_EQ(std::strtod(shortest(value).c_str(), nullptr), value);
}

}  // namespace
}  // namespace contactcheck
