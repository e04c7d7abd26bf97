#pragma once

#include <string>

#include "reference/run/suite_run.h"

namespace contactcheck {

/// Shows a run's progress on stderr: a bar on a terminal, one plain line per scene elsewhere.
class ProgressDisplay {
 public:
  ProgressDisplay(bool quiet, bool terminal) : quiet_(quiet), terminal_(terminal) {}
  ~ProgressDisplay() { finish(); }

  void show(const SuiteProgress& progress);
  /// Clears the bar.
  void finish();

 private:
  bool quiet_, terminal_, drawn_ = false;
  std::string last_scene_, last_line_;
};

}  // namespace contactcheck
