// Ctrl-C while a worker runs: the worker's process group is not the terminal's, so that the signal
// must be passed on.
#pragma once

#include <signal.h>

#include <array>
#include <cstddef>

namespace contactcheck {

/// While it lives, SIGINT, SIGTERM, SIGHUP and SIGQUIT are only remembered, unless they are ignored
/// or handled by the program already. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Has one of them come?
  bool interrupted() const;
  /// Ends this process by the signal that came. @pre interrupted()
  [[noreturn]] void die();

 private:
  void restore();

  static constexpr std::size_t kSignals = 4;
  std::array<struct sigaction, kSignals> before_ = {};
  std::array<bool, kSignals> taken_ = {};
};

}  // namespace contactcheck
