// Starts a worker as a fresh process and watches it: crashes, hangs and memory.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "reference/run/job.h"
#include "reference/run/shared_progress.h"

namespace contactcheck {

struct WorkerOutcome {
  bool done = false;   ///< the answer file is complete
  int exit_code = 0;   ///< of a worker that ended by itself
  std::string reason;  ///< why it is not done: "signal 11 (Segmentation fault)", ...
  /// Where it was when it died; no detector: in the suite's own code.
  std::optional<std::uint32_t> detector;
  std::uint32_t frame = 0;
  Phase phase = Phase::kScene;
};

/// Called a few times per second while the worker runs.
using ProgressCallback = std::function<void(double share, std::optional<std::uint32_t> detector)>;

/// Runs `executable worker JOB_FILE` with the job's limits until it ends. A worker whose step
/// counter stands still for `call_limit` seconds, or whose resident memory passes `memory_limit`,
/// is killed. @throws InputError when it cannot be started
WorkerOutcome run_supervised(const std::filesystem::path& executable,
                             const std::filesystem::path& job_file, const RunSettings& settings,
                             const ProgressCallback& on_progress);

}  // namespace contactcheck
