// A worker's place among processes: its supervisor, and everything that a detector may change for
// the detectors that come after it.
#pragma once

#include <string>
#include <vector>

#include "reference/run/output_watch.h"
#include "reference/run/process_guard.h"
#include "reference/run/shared_progress.h"

namespace contactcheck {

/// Makes this process end with its supervisor, and before it where memory ends.
void end_with_supervisor();

/// Maps the supervisor's page, for this process and no copy of it, and makes this process end with
/// its supervisor. `fallback` where there is no such page.
SharedProgress* join_supervisor(int progress_fd, SharedProgress* fallback);

/// Of a whole worker. Between detectors only: see OutputWatch and ProcessGuard.
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

}  // namespace contactcheck
