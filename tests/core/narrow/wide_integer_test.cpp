// WideInteger: where its limbs move from the object to the heap and back, and at its largest size.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

#include "core/narrow/exact_integer.h"

namespace contactcheck::test {
namespace {

constexpr std::size_t kInlineLimbs = 24;

WideInteger wide(double value) { return WideInteger::from_double(value, 0); }

bool same_value(const WideInteger& a, const WideInteger& b) { return (a - b).sign() == 0; }

/// 2^(64 limbs).
WideInteger power(std::size_t limbs) {
  WideInteger result = WideInteger::from_unsigned(1), square = wide(0x1p64);
  for (; limbs > 0; limbs /= 2) {
    if (limbs % 2 == 1) result = result * square;
    if (limbs > 1) square = square * square;
  }
  return result;
}

/// The largest integer of so many limbs.
WideInteger largest(std::size_t limbs) { return power(limbs) - WideInteger::from_unsigned(1); }

TEST(WideInteger, FromUnsignedIsTheNumber) {
  EXPECT_EQ(WideInteger::from_unsigned(0).sign(), 0);
  EXPECT_TRUE(same_value(WideInteger::from_unsigned(1), wide(1)));
  EXPECT_TRUE(same_value(WideInteger::from_unsigned(std::uint64_t{1} << 63), wide(0x1p63)));
  EXPECT_TRUE(same_value(WideInteger::from_unsigned(~std::uint64_t{0}), wide(0x1p64) - wide(1)));
}

TEST(WideInteger, CarryLeavesTheObjectAndBorrowReturns) {
  for (std::size_t limbs = kInlineLimbs - 2; limbs <= kInlineLimbs + 2; ++limbs) {
    const WideInteger one = wide(1), all_ones = largest(limbs);
    const WideInteger carried = all_ones + one;
    EXPECT_TRUE(same_value(carried, power(limbs))) << limbs;
    EXPECT_TRUE(same_value(carried - one, all_ones)) << limbs;
    EXPECT_TRUE(same_value(carried - all_ones, one)) << limbs;
    EXPECT_TRUE(same_value(all_ones - carried, -one)) << limbs;
    // (2^n - 1)^2 = 2^2n - 2^(n + 1) + 1
    EXPECT_TRUE(
        same_value(all_ones * all_ones, power(2 * limbs) - power(limbs) - power(limbs) + one))
        << limbs;
  }
}

TEST(WideInteger, CopiesAndMovesOfEverySize) {
  for (const std::size_t limbs :
       {std::size_t{1}, kInlineLimbs - 1, kInlineLimbs, kInlineLimbs + 1, std::size_t{200}}) {
    const WideInteger value = -largest(limbs);
    for (const std::size_t before : {std::size_t{0}, std::size_t{3}, kInlineLimbs + 1}) {
      WideInteger copy = before == 0 ? WideInteger() : largest(before);
      copy = value;
      EXPECT_TRUE(same_value(copy, value)) << limbs;
      WideInteger moved = before == 0 ? WideInteger() : largest(before);
      moved = std::move(copy);
      EXPECT_TRUE(same_value(moved, value)) << limbs;
      copy = WideInteger(std::move(moved));
      EXPECT_TRUE(same_value(copy, value)) << limbs;
      const WideInteger& itself = copy;
      copy = itself;
      EXPECT_TRUE(same_value(copy, value)) << limbs;
    }
    EXPECT_TRUE(same_value(-(-value), value)) << limbs;
  }
}

// A difference of wide numbers may have few limbs, which then are on the heap.
TEST(WideInteger, SmallDifferencesOfLargeNumbersBehaveAsSmallNumbers) {
  const WideInteger five = (power(100) + wide(7)) - (power(100) + wide(2));
  WideInteger copy = five;
  EXPECT_TRUE(same_value(copy, wide(5)));
  EXPECT_TRUE(same_value(copy * copy, wide(25)));
  const WideInteger moved = std::move(copy);
  EXPECT_TRUE(same_value(moved + moved, wide(10)));
  EXPECT_EQ((moved - five).sign(), 0);
  EXPECT_EQ((power(100) - power(100)).sign(), 0);
}

TEST(WideInteger, RingLawsAcrossTheInlineSize) {
  std::mt19937_64 random(71);
  const auto any = [&random] {
    WideInteger value;
    const int words = 1 + static_cast<int>(random() % 15);
    for (int i = 0; i < words; ++i)
      value = value * wide(0x1p64) + WideInteger::from_unsigned(random());
    return random() % 2 == 0 ? value : -value;
  };
  for (int i = 0; i < 300; ++i) {
    const WideInteger a = any(), b = any(), c = any();
    EXPECT_TRUE(same_value((a + b) * c, a * c + b * c));
    EXPECT_TRUE(same_value((a - b) * (a + b), a * a - b * b));
    EXPECT_TRUE(same_value(a - b, -(b - a)));
    EXPECT_TRUE(same_value(a + b - b, a));
  }
}

// Of values of any size, next to the largest one, for a guess: what is far below is zero.
TEST(WideInteger, ScaledIsAboutTheQuotientByAPowerOfLimbs) {
  for (const std::size_t size :
       {std::size_t{1}, kInlineLimbs, kInlineLimbs + 1, std::size_t{100}}) {
    const WideInteger value = power(size - 1) * wide(0x1.8p62);
    EXPECT_EQ(value.size(), size);
    EXPECT_EQ(value.scaled(size), 0x1.8p-2) << size;
    EXPECT_EQ((-value).scaled(size), -0x1.8p-2);
    EXPECT_EQ(value.scaled(size + 1), 0x1.8p-66);
    EXPECT_EQ(value.scaled(size + 15), std::ldexp(0x1.8p-2, -15 * 64));
    EXPECT_EQ(value.scaled(size + 17), 0);
    EXPECT_EQ(WideInteger().scaled(size), 0);
  }
  std::mt19937_64 random(3);
  for (int i = 0; i < 100; ++i) {
    const double a = static_cast<double>(random()), b = static_cast<double>(random());
    EXPECT_NEAR((wide(a) * wide(b)).scaled(2), a * 0x1p-64 * (b * 0x1p-64), 0x1p-50);
  }
}

TEST(WideInteger, LargestSizeFits) {
  constexpr std::size_t kHalf = WideInteger::kMaxLimbs / 2;
  EXPECT_EQ(WideInteger::kMaxLimbs, 3552U);
  EXPECT_EQ((largest(kHalf) * largest(kHalf)).sign(), 1);
  const WideInteger root = power(kHalf - 1) * wide(0x1p63), highest_bit = root * root;
  EXPECT_EQ((highest_bit + highest_bit).sign(), 1);
}

TEST(WideInteger, WiderThanTheLargestSizeAborts) {
  constexpr std::size_t kHalf = WideInteger::kMaxLimbs / 2;
  const WideInteger half = largest(kHalf);
  EXPECT_DEATH(half * half * wide(2), "wider than any predicate");
  const WideInteger root = power(kHalf - 1) * wide(0x1p63), twice = root * root + root * root;
  EXPECT_DEATH(twice + twice, "wider than any predicate");
  EXPECT_DEATH(half * half * half, "wider than any predicate");
}

}  // namespace
}  // namespace contactcheck::test
