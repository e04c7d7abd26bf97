#include "reference/reduce/simple_number.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace contactcheck::reduce {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

// From the simplest to what nobody wants to read.
TEST(Complexity, OrdersNumbersAsTheyAreRead) {
  const std::vector<double> ordered = {0.0, 1.0,  -1.0,  3.0,     5.0,      0.375,
                                       0.1, 0.07, 0.123, 0x1p-40, 1.0 / 3.0};
  for (std::size_t i = 1; i < ordered.size(); ++i)
    EXPECT_LT(complexity(ordered[i - 1]), complexity(ordered[i]))
        << ordered[i - 1] << " and " << ordered[i];
}

TEST(Complexity, OfPowersOfTwoGrowsWithTheirDistanceFromOne) {
  EXPECT_LT(complexity(4.0), complexity(0x1p20));
  EXPECT_EQ(complexity(0x1p-7), complexity(0x1p7));
}

TEST(Figures, CountBitsAndDigits) {
  EXPECT_EQ(significant_bits(0.0), 0);
  EXPECT_EQ(significant_bits(-5.0), 3);
  EXPECT_EQ(significant_bits(40.0), 3);
  EXPECT_EQ(significant_bits(5e-324), 1);
  EXPECT_EQ(significant_bits(std::numeric_limits<double>::max()), 53);
  EXPECT_EQ(decimal_digits(0.0), 0);
  EXPECT_EQ(decimal_digits(1200.0), 2);
  EXPECT_EQ(decimal_digits(-0.125), 3);
  EXPECT_EQ(decimal_digits(0.1 + 0.2), 17);
}

TEST(Rounding, ToBitsAndDigits) {
  EXPECT_EQ(rounded_to_bits(0.7, 1), 0.5);
  EXPECT_EQ(rounded_to_bits(0.7, 3), 0.75);
  EXPECT_EQ(rounded_to_bits(-100.0, 2), -96.0);
  EXPECT_EQ(rounded_to_digits(1.0 / 3.0, 2), 0.33);
  EXPECT_EQ(rounded_to_digits(1.0 / 3.0, 17), 1.0 / 3.0);
}

TEST(SimplerNumbers, OfSimpleNumbers) {
  EXPECT_THAT(simpler_numbers(0.0), IsEmpty());
  EXPECT_THAT(simpler_numbers(1.0), ElementsAre(0.0));
  EXPECT_THAT(simpler_numbers(-1.0), ElementsAre(0.0, 1.0));
}

TEST(SimplerNumbers, HaveWholeNumbersFewBitsAndFewDigits) {
  EXPECT_THAT(simpler_numbers(2.71828),
              AllOf(Contains(0.0), Contains(-1.0), Contains(3.0), Contains(2.0), Contains(2.5),
                    Contains(2.75), Contains(2.7), Contains(2.718)));
  EXPECT_THAT(simpler_numbers(2.71828), Not(Contains(2.71828)));
}

TEST(SimplerNumbers, AreSimplerDifferentAndInOrder) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> sizes(-300.0, 300.0), mantissas(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double value = mantissas(random) * std::pow(10.0, sizes(random));
    const std::vector<double> simpler = simpler_numbers(value);
    ASSERT_GT(simpler.size(), 10u) << value;
    for (std::size_t k = 0; k < simpler.size(); ++k) {
      EXPECT_TRUE(std::isfinite(simpler[k]));
      EXPECT_LT(complexity(simpler[k]), complexity(value));
      EXPECT_LE(complexity(simpler[k > 0 ? k - 1 : k]), complexity(simpler[k]));
      EXPECT_EQ(std::count(simpler.begin(), simpler.end(), simpler[k]), 1);
    }
  }
}

TEST(SimplerNumbers, StayFiniteAtTheEndsOfTheRange) {
  for (const double value : {std::numeric_limits<double>::max(), 3.3e-320, -5e-324})
    for (const double simpler : simpler_numbers(value)) EXPECT_TRUE(std::isfinite(simpler));
}

}  // namespace
}  // namespace contactcheck::reduce
