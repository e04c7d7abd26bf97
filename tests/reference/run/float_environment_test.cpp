#include "reference/run/float_environment.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace contactcheck {
namespace {

double third(double one) {
  volatile double x = one;
  return x / 3.0;
}

TEST(FloatEnvironmentGuard, SeesNothingWhenNothingChanged) {
  const FloatEnvironmentGuard guard;
  third(1.0);  // inexact: a sticky flag is no change
  EXPECT_EQ(guard.check_and_restore(), "");
}

TEST(FloatEnvironmentGuard, SeesAndRestoresTheRoundingMode) {
  const double nearest = third(1.0);
  const FloatEnvironmentGuard guard;
  std::fesetround(FE_UPWARD);
  EXPECT_NE(third(1.0), nearest) << "the test must change something";
  EXPECT_EQ(guard.check_and_restore(), "rounding mode");
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_EQ(third(1.0), nearest);
  EXPECT_EQ(guard.check_and_restore(), "");
}

#if defined(__SSE__)

constexpr unsigned kFlushToZero = 0x8000u, kDenormalsAreZero = 0x0040u;

double half_of_the_smallest_normal() {
  volatile double x = std::numeric_limits<double>::min();
  return x * 0.5;
}

TEST(FloatEnvironmentGuard, SeesRoundingThatOnlySseWasTold) {
  // glibc's fegetround looks at the x87 unit alone.
  const double nearest = third(1.0);
  const FloatEnvironmentGuard guard;
  _MM_SET_ROUNDING_MODE(_MM_ROUND_UP);
  EXPECT_NE(third(1.0), nearest);
  EXPECT_EQ(guard.check_and_restore(), "rounding mode");
  EXPECT_EQ(third(1.0), nearest);
}

TEST(FloatEnvironmentGuard, SeesAndRestoresFlushToZero) {
  const FloatEnvironmentGuard guard;
  _mm_setcsr(_mm_getcsr() | kFlushToZero);
  EXPECT_EQ(half_of_the_smallest_normal(), 0.0);
  EXPECT_EQ(guard.check_and_restore(), "flush-to-zero");
  EXPECT_GT(half_of_the_smallest_normal(), 0.0);
  EXPECT_EQ(guard.check_and_restore(), "");
}

TEST(FloatEnvironmentGuard, NamesEverythingThatChanged) {
  const FloatEnvironmentGuard guard;
  std::fesetround(FE_DOWNWARD);
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);
  EXPECT_EQ(guard.check_and_restore(), "rounding mode, flush-to-zero, denormals-are-zero");
  EXPECT_EQ(_mm_getcsr() & (kFlushToZero | kDenormalsAreZero), 0u);
}

TEST(FloatEnvironmentGuard, RestoresWhatWasSetBefore) {
  const FloatEnvironmentGuard outer;
  _mm_setcsr(_mm_getcsr() | kFlushToZero);
  {
    const FloatEnvironmentGuard guard;
    _mm_setcsr(_mm_getcsr() & ~kFlushToZero);
    EXPECT_EQ(guard.check_and_restore(), "flush-to-zero");
    EXPECT_EQ(_mm_getcsr() & kFlushToZero, kFlushToZero);
  }
  EXPECT_EQ(outer.check_and_restore(), "flush-to-zero");
}

#endif

}  // namespace
}  // namespace contactcheck
