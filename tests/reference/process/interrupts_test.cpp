// What an interrupt makes a program say, and how it ends.
#include "reference/process/interrupts.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace contactcheck::process {
namespace {

using testing::KilledBySignal;

constexpr const char* kLine = "going now\n";

TEST(Interrupts, EachSaysTheLineAndEndsTheProcess) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(
        {
          signal(number, SIG_DFL);
          say_when_interrupted(kLine);
          raise(number);
        },
        KilledBySignal(number), "^going now\n$");
  }
}

TEST(Interrupts, SayItOnceWhenAGuardHasPassedThemOn) {
  const auto pass_on = [] {
    signal(SIGINT, SIG_DFL);
    say_when_interrupted(kLine);
    try {
      InterruptGuard guard;
      raise(SIGINT);
      if (guard.interrupted()) guard.pass_on();
    } catch (const Interrupted& e) {
      die_of(e);
    }
  };
  EXPECT_EXIT(pass_on(), KilledBySignal(SIGINT), "^going now\n$");
}

TEST(Interrupts, SayItWhenAGuardHasEndedInBetween) {
  const auto miss = [] {
    signal(SIGTERM, SIG_DFL);
    say_when_interrupted(kLine);
    const InterruptGuard guard;
    raise(SIGTERM);
  };
  EXPECT_EXIT(miss(), KilledBySignal(SIGTERM), "^going now\n$");
}

TEST(Interrupts, ThatAreIgnoredStayIgnored) {
  const auto ignore = [] {
    signal(SIGHUP, SIG_IGN);
    say_when_interrupted(kLine);
    raise(SIGHUP);
    std::_Exit(0);
  };
  EXPECT_EXIT(ignore(), testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace contactcheck::process
