#include "core/narrow/exact_integer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/range_ends.h"

namespace contactcheck {
namespace {

ExactInteger integer(double value) { return ExactInteger::from_double(value, 0); }

bool equal(const ExactInteger& a, const ExactInteger& b) { return (a - b).sign() == 0; }

TEST(LowestBitExponent, OfPowersOddNumbersAndDenormals) {
  EXPECT_EQ(lowest_bit_exponent(1.0), 0);
  EXPECT_EQ(lowest_bit_exponent(-12.0), 2);
  EXPECT_EQ(lowest_bit_exponent(0.75), -2);
  EXPECT_EQ(lowest_bit_exponent(test::kSmallestDouble), -1074);
  EXPECT_EQ(lowest_bit_exponent(6 * test::kSmallestDouble), -1073);
  EXPECT_EQ(lowest_bit_exponent(std::numeric_limits<double>::min()), -1022);
  EXPECT_EQ(lowest_bit_exponent(test::kLargestDouble), 971);
  EXPECT_EQ(lowest_bit_exponent(std::nextafter(1.0, 2.0)), -52);
}

TEST(ExactInteger, SignOfZeroAndOfBothSigns) {
  EXPECT_EQ(ExactInteger().sign(), 0);
  EXPECT_EQ(integer(0.0).sign(), 0);
  EXPECT_EQ(integer(-0.0).sign(), 0);
  EXPECT_EQ(integer(3.0).sign(), 1);
  EXPECT_EQ(integer(-3.0).sign(), -1);
  EXPECT_EQ((-integer(3.0)).sign(), -1);
  EXPECT_EQ((-integer(0.0)).sign(), 0);
}

TEST(ExactInteger, SmallArithmeticAgreesWithDoubles) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 2000; ++i) {
    const auto a = static_cast<double>(static_cast<int>(random() % 200001) - 100000);
    const auto b = static_cast<double>(static_cast<int>(random() % 200001) - 100000);
    EXPECT_TRUE(equal(integer(a) + integer(b), integer(a + b))) << a << ' ' << b;
    EXPECT_TRUE(equal(integer(a) - integer(b), integer(a - b))) << a << ' ' << b;
    EXPECT_TRUE(equal(integer(a) * integer(b), integer(a * b))) << a << ' ' << b;
    EXPECT_EQ((integer(a) - integer(b)).sign(), (a > b) - (a < b));
  }
}

TEST(ExactInteger, ShiftIsAPowerOfTwoAcrossLimbBorders) {
  for (int shift = 0; shift < 300; ++shift) {
    const ExactInteger direct = ExactInteger::from_double(-5.0, -shift);
    EXPECT_TRUE(equal(direct, integer(-5.0) * integer(std::ldexp(1.0, shift)))) << shift;
  }
}

TEST(ExactInteger, CarryAndBorrowRunThroughEveryLimb) {
  const ExactInteger power = integer(0x1p640), one = integer(1.0);
  const ExactInteger ones = power - one;  // ten limbs of ones
  EXPECT_EQ(ones.sign(), 1);
  EXPECT_TRUE(equal(ones + one, power));
  EXPECT_TRUE(equal(one - power, -ones));
  // (2^640 - 1)^2 = 2^1280 - 2^641 + 1
  EXPECT_TRUE(equal(ones * ones, power * power - integer(0x1p641) + one));
}

TEST(ExactInteger, LargestAndSmallestDoubleTogether) {
  const ExactInteger large = ExactInteger::from_double(test::kLargestDouble, -1074);
  const ExactInteger small = ExactInteger::from_double(test::kSmallestDouble, -1074);
  EXPECT_TRUE(equal(small, integer(1.0)));
  EXPECT_EQ((large + small - large).sign(), 1);
  EXPECT_EQ((large - small - large).sign(), -1);
  EXPECT_TRUE(equal(large * small, large));
}

TEST(ExactInteger, WidestDeterminantFits) {
  const ExactInteger span = ExactInteger::from_double(test::kLargestDouble, -1074) * integer(2.0);
  const ExactInteger minor = span * span + span * span;
  const ExactInteger sum = minor * span + minor * span + minor * span;
  EXPECT_EQ(sum.sign(), 1);
  EXPECT_TRUE(equal(sum, span * span * span * integer(6.0)));
}

TEST(ExactInteger, WiderThanAnyDeterminantAborts) {
  const ExactInteger wide = ExactInteger::from_double(test::kLargestDouble, -1074);
  EXPECT_DEATH(wide * wide * wide * wide, "wider than any predicate");
}

TEST(ExactInteger, RingLawsOnWideRandomValues) {
  std::mt19937_64 random(12);
  const auto any = [&random] {
    const auto mantissa = static_cast<double>(static_cast<std::int64_t>(random()));
    return ExactInteger::from_double(std::ldexp(mantissa, static_cast<int>(random() % 900)), 0);
  };
  for (int i = 0; i < 300; ++i) {
    const ExactInteger a = any(), b = any(), c = any();
    EXPECT_TRUE(equal((a + b) * c, a * c + b * c));
    EXPECT_TRUE(equal((a - b) * (a + b), a * a - b * b));
    EXPECT_TRUE(equal(a - b, -(b - a)));
    EXPECT_TRUE(equal(a + b - b, a));
  }
}

}  // namespace
}  // namespace contactcheck
