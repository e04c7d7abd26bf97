#include "reference/run/interrupts.h"

#include <cstdlib>

namespace contactcheck {
namespace {

constexpr std::array kNumbers = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

volatile sig_atomic_t interrupt = 0;

void remember(int number) { interrupt = number; }

}  // namespace

InterruptGuard::InterruptGuard() {
  static_assert(kNumbers.size() == kSignals);
  interrupt = 0;
  struct sigaction ours = {};
  ours.sa_handler = remember;
  sigemptyset(&ours.sa_mask);
  ours.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < kSignals; ++i) {
    sigaction(kNumbers[i], nullptr, &before_[i]);
    const bool by_default =
        (before_[i].sa_flags & SA_SIGINFO) == 0 && before_[i].sa_handler == SIG_DFL;
    taken_[i] = by_default && sigaction(kNumbers[i], &ours, nullptr) == 0;
  }
}

InterruptGuard::~InterruptGuard() {
  restore();
  if (interrupted()) raise(interrupt);  // it came when nobody looked any more
}

bool InterruptGuard::interrupted() const { return interrupt != 0; }

void InterruptGuard::pass_on() {
  const Interrupted out{interrupt};
  interrupt = 0;
  throw out;
}

void InterruptGuard::restore() {
  for (std::size_t i = 0; i < kSignals; ++i)
    if (taken_[i]) sigaction(kNumbers[i], &before_[i], nullptr);
}

void die_of(const Interrupted& interrupted) {
  raise(interrupted.signal);
  std::abort();  // not reached: the default of all four is to end the process
}

}  // namespace contactcheck
