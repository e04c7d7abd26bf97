// Ctrl-C while a worker runs: the worker's process group is not the terminal's, so that the signal
// must be passed on.
#pragma once

#include <signal.h>

#include <array>
#include <cstddef>

namespace contactcheck::process {

/// A signal that asks this program to end; thrown where it is noticed, so that destructors clean
/// up.
struct Interrupted {
  int signal = 0;
};

/// While it lives, SIGINT, SIGTERM, SIGHUP and SIGQUIT are only recorded, unless the program
/// already ignores or handles them. At most one guard at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// True if one of them was received.
  bool interrupted() const;
  /// Throws the signal that came, as Interrupted. @pre interrupted()
  [[noreturn]] void pass_on();

 private:
  void restore();

  static constexpr std::size_t kSignals = 4;
  std::array<struct sigaction, kSignals> before_ = {};
  std::array<bool, kSignals> taken_ = {};
};

/// From now on, each of these signals writes `line` to standard error before it ends this process,
/// unless it is ignored or handled already. Guards work as before.
/// @pre `line` lives until the process ends
void say_when_interrupted(const char* line);

/// Ends this process by that signal.
[[noreturn]] void die_of(const Interrupted& interrupted);

}  // namespace contactcheck::process
