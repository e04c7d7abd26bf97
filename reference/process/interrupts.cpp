#include "reference/process/interrupts.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace contactcheck::process {
namespace {

constexpr std::array kNumbers = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

volatile sig_atomic_t interrupt = 0;

const char* last_line = "";

void remember(int number) { interrupt = number; }

// The signal may come in the middle of anything: nothing but calls that are allowed then. The
// handler is used once; what it raises ends the process when it returns.
void say_and_die(int number) {
  if (write(STDERR_FILENO, last_line, std::strlen(last_line)) < 0) {
    // Nothing can be reported; the process ends all the same.
  }
  raise(number);
}

bool is_free(const struct sigaction& action) {
  if ((action.sa_flags & SA_SIGINFO) != 0) return false;
  return action.sa_handler == SIG_DFL || action.sa_handler == say_and_die;
}

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
    taken_[i] = is_free(before_[i]) && sigaction(kNumbers[i], &ours, nullptr) == 0;
  }
}

InterruptGuard::~InterruptGuard() {
  restore();
  if (interrupted()) raise(interrupt);  // it came after the last check
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

void say_when_interrupted(const char* line) {
  last_line = line;
  struct sigaction ours = {};
  ours.sa_handler = say_and_die;
  sigemptyset(&ours.sa_mask);
  ours.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : kNumbers) {
    struct sigaction before = {};
    sigaction(number, nullptr, &before);
    if (is_free(before)) sigaction(number, &ours, nullptr);
  }
}

void die_of(const Interrupted& interrupted) {
  raise(interrupted.signal);
  std::abort();  // not reached: the default of all four is to end the process
}

}  // namespace contactcheck::process
