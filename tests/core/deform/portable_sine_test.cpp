#include "core/deform/portable_sine.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/types/hash.h"

namespace contactcheck {
namespace {

TEST(PortableSine, IsNearTheTrueValuesAllRound) {
  for (int i = -14400; i <= 14400; ++i) {
    const double degrees = 0.05 * i;
    const long double radians =
        static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180;
    const SineCosine at = portable_sine_cosine(degrees);
    ASSERT_NEAR(at.sine, static_cast<double>(std::sin(radians)), 0x1p-50) << degrees;
    ASSERT_NEAR(at.cosine, static_cast<double>(std::cos(radians)), 0x1p-50) << degrees;
  }
}

TEST(PortableSine, IsExactAtQuarters) {
  const double sines[] = {0.0, 1.0, 0.0, -1.0};
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const SineCosine at = portable_sine_cosine(90.0 * quarter);
    EXPECT_EQ(at.sine, sines[(quarter + 8) % 4]) << quarter;
    EXPECT_EQ(at.cosine, sines[(quarter + 9) % 4]) << quarter;
  }
}

TEST(PortableSine, HasTheSameBitsOnEveryMachine) {
  Fnv1a hash;
  for (int i = -5000; i <= 5000; ++i) {
    const SineCosine at = portable_sine_cosine(0.1375 * i);
    hash.value(at.sine);
    hash.value(at.cosine);
  }
  EXPECT_EQ(hash.digest(), 0x2373ad7ab8f0fd18ull) << std::hex << hash.digest();
}

}  // namespace
}  // namespace contactcheck
