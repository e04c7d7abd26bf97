#include "reference/suite/supervisor.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "core/types/check.h"
#include "reference/process/interrupts.h"
#include "reference/process/shared_page.h"
#include "reference/process/worker_process.h"
#include "reference/timing/cache_sweep.h"

namespace contactcheck::suite {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPollInterval = std::chrono::milliseconds(20);
// For a worker whose answer is complete: destructors and exit handlers of libraries may hang.
constexpr double kSecondsToLeave = 5.0;
// Without a step of the suite's own code, however short the limit of one call: an exact judgement
// of a large frame may take longer than a detector is given.
constexpr double kSecondsOfOwnCode = 60.0;

std::string short_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

// The page is the worker's to write: a library that has lost its way may have put anything there.
std::optional<std::uint32_t> checked(std::uint32_t detector, const RunSettings& settings) {
  if (detector == process::SharedProgress::kNoDetector) return std::nullopt;
  if (!settings.detectors.empty() && detector >= settings.detectors.size()) return std::nullopt;
  return detector;
}

WorkerProgress place_of(const process::SharedProgress& progress, const RunSettings& settings) {
  WorkerProgress place;
  place.share = std::min(progress.permille / 1000.0, 1.0);
  place.detector = checked(progress.detector, settings);
  if (place.detector || progress.phase == process::Phase::kTruth) place.frame = progress.frame;
  return place;
}

// Watches for stand-still, memory and output; says which limit was passed, or "".
class Watch {
 public:
  Watch(const process::SharedProgress& progress, const RunSettings& settings)
      : progress_(progress), settings_(settings) {}

  std::string broken_limit(const process::WorkerProcess& worker) {
    const double limit = seconds_allowed();
    if (seconds_without_step() > limit)
      return "no progress for " + short_text(limit) + " s (time limit of one call)";
    if (worker.resident_bytes() > settings_.memory_limit + own_bytes_)
      return "more than " + std::to_string(settings_.memory_limit >> 20) +
             " MiB resident (memory limit)";
    if (worker.output_bytes() > process::kWorkerOutputLimit)
      return "more than " + std::to_string(process::kWorkerOutputLimit >> 20) +
             " MiB written to standard output and error (output limit)";
    return "";
  }

 private:
  double seconds_allowed() const {
    if (progress_.phase == process::Phase::kDone)
      return std::min(kSecondsToLeave, settings_.call_limit);
    if (progress_.detector == process::SharedProgress::kNoDetector)
      return std::max(kSecondsOfOwnCode, settings_.call_limit);
    return settings_.call_limit;
  }

  double seconds_without_step() {
    const std::uint64_t ticks = progress_.ticks;
    const Clock::time_point now = Clock::now();
    if (ticks != last_ticks_) {
      last_ticks_ = ticks;
      last_change_ = now;
    }
    return std::chrono::duration<double>(now - last_change_).count();
  }

  const process::SharedProgress& progress_;
  const RunSettings& settings_;
  const std::uint64_t own_bytes_ = settings_.timing ? timing::sweep_bytes() : 0;  // for the caches
  std::uint64_t last_ticks_ = 0;
  Clock::time_point last_change_ = Clock::now();
};

// Until the worker has ended, by itself or by a limit, which is given back.
std::string watch_to_the_end(process::WorkerProcess& worker,
                             const process::SharedProgress& progress, const RunSettings& settings,
                             const ProgressCallback& on_progress) {
  process::InterruptGuard interrupts;
  Watch watch(progress, settings);
  std::string limit;
  while (!worker.has_ended()) {
    std::this_thread::sleep_for(kPollInterval);
    if (interrupts.interrupted()) {
      worker.kill();
      worker.reap();
      interrupts.pass_on();
    }
    if (limit.empty()) {
      limit = watch.broken_limit(worker);
      if (!limit.empty()) worker.kill();
    }
    on_progress(place_of(progress, settings));
  }
  return limit;
}

WorkerOutcome outcome_of(const process::SharedProgress& progress, const RunSettings& settings,
                         int status, const std::string& limit) {
  WorkerOutcome out;
  // The phase decides, not the exit code: a library may call exit(0) in the middle, or crash when
  // it is torn down, after the answer was written.
  out.done = progress.phase == process::Phase::kDone;
  out.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  out.killed = WIFSIGNALED(status);
  if (out.done) return out;
  out.over_limit = !limit.empty();
  out.reason = limit.empty() ? process::describe_status(status) : limit;
  out.detector = checked(progress.detector, settings);
  out.last_detector = checked(progress.last_detector, settings);
  out.frame = progress.frame;
  out.phase = progress.phase;
  return out;
}

}  // namespace

WorkerOutcome run_supervised(const std::filesystem::path& executable,
                             const std::filesystem::path& job_file, const RunSettings& settings,
                             const ProgressCallback& on_progress) {
  const process::SharedPage<process::SharedProgress> page("contactcheck-progress");
  process::WorkerProcess worker(executable,
                                {"worker", job_file.string(), "--progress-fd",
                                 std::to_string(process::WorkerProcess::kInheritedFd)},
                                page.fd());
  const std::string limit = watch_to_the_end(worker, page.value(), settings, on_progress);
  const int status = worker.reap();
  WorkerOutcome outcome = outcome_of(page.value(), settings, status, limit);
  if (!outcome.done) outcome.error_text = worker.error_text();
  return outcome;
}

}  // namespace contactcheck::suite
