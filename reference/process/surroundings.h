// A worker among processes: its supervisor, and the global state that a detector may change for the
// detectors after it.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <cstdio>
#include <string>
#include <vector>

#include "reference/process/shared_progress.h"

namespace contactcheck::process {

// Records what detectors write to the worker's standard output and error, which the supervisor has
// redirected to files, in the row of that detector.

/// Watches both streams. Between detectors only: it empties buffers and makes system calls.
class OutputWatch {
 public:
  /// `active` false: watches nothing (a worker that was started by hand has the user's streams).
  explicit OutputWatch(bool active);
  ~OutputWatch();
  OutputWatch(const OutputWatch&) = delete;
  OutputWatch& operator=(const OutputWatch&) = delete;

  /// What was written since the last call, one sentence for each stream ("wrote to standard output:
  /// "first line""), and whether a stream was closed or replaced. Empties the files and restores
  /// the streams.
  std::vector<std::string> take();

 private:
  struct Stream {
    int number = -1;  ///< 1 or 2
    FILE** file = nullptr;
    const char* name = "";
    int kept = -1;  ///< a second descriptor of the file; -1: given up
    dev_t device = 0;
    ino_t inode = 0;
  };

  static bool is_file_of(const Stream& stream, int descriptor);
  static bool restore(Stream& stream);
  static std::string take_text(const Stream& stream);

  std::vector<Stream> streams_;
};

// What a library may change for the whole process: the locale (a decimal comma in all later
// output), working directory, file mode mask, signal handlers and mask, timers.

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

/// Makes this process end with its supervisor, and before it where memory ends, and adopt orphans
/// (process_tree.h).
void end_with_supervisor();

/// Maps the supervisor's page, for this process and no copy of it, and makes this process end with
/// its supervisor. `fallback` where there is no such page.
SharedProgress* join_supervisor(int progress_fd, SharedProgress* fallback);

/// Both of the above for a whole worker. Only between detectors: see OutputWatch and ProcessGuard.
class Surroundings {
 public:
  /// `supervised`: the standard streams are the supervisor's files.
  explicit Surroundings(bool supervised);

  /// Undoes what was changed since the last call; one sentence for each change and each stream that
  /// was written to.
  std::vector<std::string> restore();

 private:
  OutputWatch output_;
  const ProcessGuard process_;
};

}  // namespace contactcheck::process
