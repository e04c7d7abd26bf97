// What `run --json-lines` says: one JSON object a line (schema contactcheck-events/1,
// fixtures/README.md).
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "reference/suite/suite_request.h"

namespace contactcheck::cli {

/// Each is one line without its end.
std::string start_event(const suite::SuiteRequest& request);
std::string progress_event(const suite::SuiteProgress& progress,
                           std::optional<double> seconds_left);
std::string scene_event(const suite::SceneEnd& end);
std::string end_event(const std::filesystem::path& out, int exit_code);

/// Prints events to stdout and flushes after each.
class EventLines {
 public:
  explicit EventLines(bool wanted) : wanted_(wanted) {}

  bool wanted() const { return wanted_; }
  void print(const std::string& event) const;
  /// Prints the first progress of a scene, and then at most four a second.
  void progress(const suite::SuiteProgress& progress, std::optional<double> seconds_left);

 private:
  bool wanted_;
  std::string last_scene_;
  std::chrono::steady_clock::time_point last_ = {};
};

}  // namespace contactcheck::cli
