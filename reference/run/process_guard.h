// What a library may change for the whole process: the locale (a decimal comma in every number
// that is printed from then on), the working directory, handlers of signals, timers.
#pragma once

#include <signal.h>

#include <string>
#include <vector>

namespace contactcheck {

/// Remembers the state of the process at construction. Costs about a hundred system calls: between
/// detectors only, never while one is timed.
class ProcessGuard {
 public:
  ProcessGuard();
  /// What differs now, one sentence each ("changed the locale"); restores the remembered state.
  std::vector<std::string> check_and_restore() const;

 private:
  struct Handler {
    int number = 0;
    struct sigaction action = {};
  };

  bool restore_locale() const;
  bool restore_directory() const;
  bool restore_umask() const;
  std::string restore_handlers() const;
  bool restore_mask() const;

  std::string locale_, directory_;
  mode_t umask_ = 0;
  std::vector<Handler> handlers_;
  sigset_t blocked_ = {};
};

}  // namespace contactcheck
