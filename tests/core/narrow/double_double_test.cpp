#include "core/narrow/double_double.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "core/narrow/exact_integer.h"

namespace contactcheck::test {
namespace {

/// Every number below is a multiple of 2^kUnit, and every product of two of 2^(2 kUnit).
constexpr int kUnit = -600;

ExactInteger exact(double value, int unit) { return ExactInteger::from_double(value, unit); }
ExactInteger exact(const DoubleDouble& value, int unit) {
  return exact(value.high, unit) + exact(value.low, unit);
}

bool same(const ExactInteger& a, const ExactInteger& b) { return (a - b).sign() == 0; }

ExactInteger magnitude_of(const ExactInteger& a) { return a.sign() < 0 ? -a : a; }

/// Whether |approximate - truth| * scale <= |truth|.
bool within(const ExactInteger& approximate, const ExactInteger& truth, double scale) {
  const ExactInteger error = magnitude_of(approximate - truth) * exact(scale, 0);
  return (magnitude_of(truth) - error).sign() >= 0;
}

/// low is at most half a unit in the last place of high.
bool is_normalised(const DoubleDouble& value) { return value.high + value.low == value.high; }

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}

  /// Of 53 bits, some of them with long runs of zeros or of ones, and of exponents within +-range.
  double number(int range) {
    std::uint64_t bits = random_();
    const auto kind = random_() % 4;
    if (kind == 0) bits &= random_() & random_() & random_();
    if (kind == 1) bits |= random_() | random_() | random_();
    const double mantissa = static_cast<double>((bits >> 12) | (std::uint64_t{1} << 52));
    const auto width = 2 * static_cast<std::uint64_t>(range) + 1;
    const int exponent = static_cast<int>(random_() % width) - range - 52;
    return std::ldexp(random_() % 2 == 0 ? mantissa : -mantissa, exponent);
  }
  /// A pair whose low word is anything from a full half unit to zero.
  DoubleDouble pair(int range) {
    const double high = number(range);
    const double unit = std::abs(std::nextafter(high, 2 * high) - high);
    const double low = number(0) / 4 * unit * std::ldexp(1.0, -static_cast<int>(random_() % 40));
    return DoubleDouble::sum(high, random_() % 8 == 0 ? 0.0 : low);
  }
  /// Near -value: the high words cancel, wholly or nearly so.
  DoubleDouble nearly_opposite(const DoubleDouble& value) {
    const double high = random_() % 2 == 0 ? value.high : std::nextafter(value.high, number(0));
    return DoubleDouble::sum(-high, value.low * number(0) / 2);
  }
  bool chance(unsigned one_in) { return random_() % one_in == 0; }

 private:
  std::mt19937_64 random_;
};

TEST(DoubleDouble, SumOfTwoDoublesIsExact) {
  Numbers numbers(61);
  for (int i = 0; i < 3000; ++i) {
    const double a = numbers.number(i % 2 == 0 ? 60 : 200);
    const double b = numbers.chance(4) ? -std::nextafter(a, 0.0) : numbers.number(60);
    const DoubleDouble sum = DoubleDouble::sum(a, b);
    EXPECT_TRUE(same(exact(sum, kUnit), exact(a, kUnit) + exact(b, kUnit))) << a << ' ' << b;
    EXPECT_EQ(sum.high, a + b);
  }
}

TEST(DoubleDouble, ProductOfTwoDoublesIsExact) {
  Numbers numbers(62);
  for (int i = 0; i < 3000; ++i) {
    const double a = numbers.number(200), b = numbers.number(200);
    const DoubleDouble product = DoubleDouble::product(a, b);
    EXPECT_TRUE(same(exact(product, 2 * kUnit), exact(a, kUnit) * exact(b, kUnit)))
        << a << ' ' << b;
    EXPECT_EQ(product.high, a * b);
  }
}

TEST(DoubleDouble, SmallWholeNumbersAreExact) {
  for (int a = -20; a <= 20; ++a)
    for (int b = -20; b <= 20; ++b) {
      const DoubleDouble x(a), y(b);
      EXPECT_EQ((x + y).high, a + b);
      EXPECT_EQ((x - y).high, a - b);
      EXPECT_EQ((x * y).high, a * b);
      EXPECT_EQ((x + y).low, 0);
      EXPECT_EQ((x - y).low, 0);
      EXPECT_EQ((x * y).low, 0);
    }
}

/// Errors of sums, differences and products over their bound.
struct Errors {
  int too_large = 0;
  int noticed = 0;  ///< more than a sixteenth of the bound

  void add(const ExactInteger& approximate, const ExactInteger& truth) {
    too_large += !within(approximate, truth, 1 / kDoubleDoubleError);
    noticed += !within(approximate, truth, 16 / kDoubleDoubleError);
  }
};

TEST(DoubleDouble, SumsKeepTheErrorBound) {
  Numbers numbers(63);
  Errors errors;
  for (int i = 0; i < 6000; ++i) {
    const DoubleDouble a = numbers.pair(150);
    const DoubleDouble b = numbers.chance(3) ? numbers.nearly_opposite(a)
                           : numbers.chance(2)
                               ? DoubleDouble::sum(a.high / 2, numbers.pair(0).low * a.high)
                               : numbers.pair(150);
    const DoubleDouble sum = a + b, difference = a - b;
    errors.add(exact(sum, kUnit), exact(a, kUnit) + exact(b, kUnit));
    errors.add(exact(difference, kUnit), exact(a, kUnit) - exact(b, kUnit));
    EXPECT_TRUE(is_normalised(sum) && is_normalised(difference));
  }
  EXPECT_EQ(errors.too_large, 0);
  EXPECT_GT(errors.noticed, 0);
}

TEST(DoubleDouble, ProductsKeepTheErrorBound) {
  Numbers numbers(64);
  Errors errors;
  for (int i = 0; i < 6000; ++i) {
    const DoubleDouble a = numbers.pair(i % 2 == 0 ? 0 : 150),
                       b = numbers.pair(i % 2 == 0 ? 0 : 150);
    const DoubleDouble product = a * b;
    errors.add(exact(product, 2 * kUnit), exact(a, kUnit) * exact(b, kUnit));
    EXPECT_TRUE(is_normalised(product));
  }
  EXPECT_EQ(errors.too_large, 0);
  EXPECT_GT(errors.noticed, 0);
}

TEST(DoubleDouble, KeepsTheBoundAtTheEndsOfItsRange) {
  // Products of 2^989 and above 2^-900, sums of 2^989.
  Numbers numbers(65);
  constexpr int kSmallUnit = -1074;
  Errors errors;
  for (int i = 0; i < 300; ++i) {
    const double large = std::ldexp(numbers.number(0), 490),
                 larger = std::ldexp(numbers.number(0), 497);
    const double small = std::ldexp(numbers.number(0), -449);
    const DoubleDouble product = DoubleDouble(large) * DoubleDouble(larger);
    EXPECT_TRUE(same(exact(product, 0), exact(large, 0) * exact(larger, 0)));
    const DoubleDouble tiny = DoubleDouble(small) * DoubleDouble(small);
    errors.add(exact(tiny, 2 * kSmallUnit), exact(small, kSmallUnit) * exact(small, kSmallUnit));
    const DoubleDouble sum = product + DoubleDouble(large);
    errors.add(exact(sum, 0), exact(product, 0) + exact(large, 0));
  }
  EXPECT_EQ(errors.too_large, 0);
}

}  // namespace
}  // namespace contactcheck::test
