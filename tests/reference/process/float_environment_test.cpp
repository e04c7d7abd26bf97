#include "reference/process/float_environment.h"

#include <gtest/gtest.h>

#include <fenv.h>

#include <cfenv>
#include <limits>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace contactcheck::process {
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

double sum_of_long_doubles() {
  volatile long double x = 1.0L;
  return static_cast<double>(x / 3.0L);
}

TEST(FloatEnvironmentGuard, SeesAndRestoresTrapsThatArePending) {
  const FloatEnvironmentGuard guard;
  third(1.0);
  sum_of_long_doubles();  // both units have an inexact result behind them
  feenableexcept(FE_ALL_EXCEPT);
  EXPECT_EQ(guard.check_and_restore(), "traps");
  EXPECT_EQ(fegetexcept(), 0);
  third(1.0);  // would be SIGFPE
  sum_of_long_doubles();
  EXPECT_EQ(guard.check_and_restore(), "");
}

TEST(FloatEnvironmentGuard, SeesTrapsThatOnlySseWasTold) {
  const FloatEnvironmentGuard guard;
  _mm_setcsr(_mm_getcsr() & ~0x1000u);  // inexact results
  EXPECT_EQ(guard.check_and_restore(), "traps");
  third(1.0);
  EXPECT_EQ(guard.check_and_restore(), "");
}

TEST(FloatEnvironmentGuard, SeesAndRestoresThePrecisionOfTheOldUnit) {
  const double before = sum_of_long_doubles();
  const FloatEnvironmentGuard guard;
  unsigned short word = 0;
  __asm__ volatile("fnstcw %0" : "=m"(word));
  word = static_cast<unsigned short>(word & ~0x0300u);  // single precision
  __asm__ volatile("fldcw %0" : : "m"(word));
  EXPECT_NE(sum_of_long_doubles(), before);
  EXPECT_EQ(guard.check_and_restore(), "x87 precision");
  EXPECT_EQ(sum_of_long_doubles(), before);
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
}  // namespace contactcheck::process
