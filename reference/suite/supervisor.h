// Starts a worker as a fresh process and watches it: crashes, hangs, memory and output.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "reference/process/shared_progress.h"
#include "reference/suite/job.h"

namespace contactcheck::suite {

struct WorkerOutcome {
  bool done = false;        ///< the answer file is complete
  int exit_code = 0;        ///< of a worker that ended by itself
  bool killed = false;      ///< by a signal, its own or the supervisor's
  bool over_limit = false;  ///< for a limit of the job that it passed
  std::string reason;       ///< why it is not done: "signal 11 (Segmentation fault)", ...
  /// Where it was when it died; no detector: in the suite's own code.
  std::optional<std::uint32_t> detector;
  /// The detector that had run last before it died; none: it died before any had run.
  std::optional<std::uint32_t> last_detector;
  std::uint32_t frame = 0;
  process::Phase phase = process::Phase::kScene;
  bool timed = false;      ///< it timed what had been judged
  std::string error_text;  ///< what a worker that is not done had on its standard error at the end
};

/// Where a worker is.
struct WorkerProgress {
  double share = 0.0;                     ///< of its work
  std::optional<std::uint32_t> detector;  ///< none: in the suite's own code
  std::optional<std::uint32_t> frame;     ///< that a detector answers or the oracle judges
};

/// Called a few times per second while the worker runs.
using ProgressCallback = std::function<void(const WorkerProgress&)>;

/// Runs `executable worker JOB_FILE` with the job's limits until it ends; children that it leaves
/// behind are ended with it. A worker is killed whose step counter stands still for `call_limit`
/// seconds, whose resident memory, with that of all that it has started and without what sweeps
/// caches for timing, passes `memory_limit`, or whose output passes 64 MiB.
/// @throws InputError when it cannot be started; Interrupted, after the worker's end, when this
/// program is asked to end
WorkerOutcome run_supervised(const std::filesystem::path& executable,
                             const std::filesystem::path& job_file, const RunSettings& settings,
                             const ProgressCallback& on_progress);

}  // namespace contactcheck::suite
