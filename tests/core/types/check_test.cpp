#include "core/types/check.h"

#include <gtest/gtest.h>

namespace contactcheck {
namespace {

TEST(Invariant, HoldingDoesNothing) { CONTACTCHECK_INVARIANT(1 + 1 == 2, "arithmetic"); }

TEST(InvariantDeathTest, BrokenAbortsInEveryBuildAndNamesPlaceAndReason) {
  EXPECT_DEATH(CONTACTCHECK_INVARIANT(1 + 1 == 3, "sums are sums"),
               "check_test.cpp:[0-9]+: broken invariant: 1 \\+ 1 == 3 sums are sums");
}

TEST(InputError, IsNotARefusal) {
  // The runner tells the two apart: exit code 2 against status `refused`.
  try {
    throw RefusedInput("a NaN vertex");
  } catch (const InputError&) {
    FAIL() << "RefusedInput was caught as InputError";
  } catch (const RefusedInput& e) {
    EXPECT_STREQ(e.what(), "a NaN vertex");
  }
}

}  // namespace
}  // namespace contactcheck
