#pragma once

#include <optional>
#include <string>

#include "reference/suite/suite_request.h"

namespace contactcheck::cli {

/// Seconds that the rest will take when it goes on as from `first_share` on; none before there is
/// anything to go by.
std::optional<double> seconds_left(double elapsed, double first_share, double share);

/// "2:03 left", "1:02:03 left"
std::string time_left_text(double seconds);

/// The bar, share, time left, scene, detector and frame, as one line of at most `columns`.
std::string progress_line(const suite::SuiteProgress& progress, std::optional<double> seconds_left,
                          std::size_t columns);

/// Shows a run's progress on stderr: a bar on a terminal, one plain line per scene elsewhere.
class ProgressDisplay {
 public:
  ProgressDisplay(bool quiet, bool terminal) : quiet_(quiet), terminal_(terminal) {}
  ~ProgressDisplay() { finish(); }

  void show(const suite::SuiteProgress& progress, std::optional<double> seconds_left);
  /// Clears the bar.
  void finish();

 private:
  bool quiet_, terminal_, drawn_ = false;
  std::string last_scene_, last_line_;
};

}  // namespace contactcheck::cli
