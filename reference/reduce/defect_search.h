// Finds the frame and the bodies in which a detector's error is reduced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reference/process/interrupts.h"
#include "reference/process/worker_process.h"
#include "reference/reduce/candidate.h"
#include "reference/reduce/channel.h"
#include "reference/reduce/task.h"
#include "reference/reduce/verdict.h"

namespace contactcheck::reduce {

// Queries a detector about frames of a few bodies, one after another, in a separate process. If it
// crashes, hangs or exhausts memory, only that process ends, and this is its answer.

struct ProbeSettings {
  std::filesystem::path executable;  ///< this program, for its hidden subcommand `probe`
  std::string detector;              ///< canonical name
  std::vector<std::string> plugins;  ///< as RunSettings::plugins
  double call_limit = 10.0;          ///< seconds that a detector may take for one frame
  std::uint64_t memory_limit = std::uint64_t{4} << 30;  ///< bytes resident
};

class Probe {
 public:
  explicit Probe(ProbeSettings settings) : settings_(std::move(settings)) {}

  /// What the detector answers, made anew or prepared again, judged at `levels` as `contactcheck
  /// run` judges it.
  /// @throws std::runtime_error when the suite's own code cannot judge the frame; Interrupted
  ProbeVerdict ask(const Snapshot& snapshot, const std::vector<Level>& levels);
  /// The next question is asked in a fresh process.
  void restart() { connection_.reset(); }
  std::size_t asked() const { return asked_; }

 private:
  struct Connection {
    Connection(const ProbeSettings& settings, Channel theirs, Channel own);
    Channel channel;
    process::WorkerProcess process;
  };

  void connect();
  void pass_on_interrupt();
  std::optional<ProbeVerdict> exchange(const std::string& request);
  std::string limit_passed_before_message(double seconds);
  bool leaves_by_itself() const;
  ProbeVerdict end_of_process(const std::string& limit);

  ProbeSettings settings_;
  std::unique_ptr<Connection> connection_;
  process::InterruptGuard interrupts_;
  std::size_t asked_ = 0;
};

/// What is reduced: a frame in which the detector was seen to err, of two bodies, of one, or where
/// those alone show nothing, of no more than it takes.
struct Defect {
  ReductionTask task;
  Finding finding;
};

/// "scene, frame 3": as a message begins.
std::string where(const ReductionTask& task);

/// At which levels answers are judged to see an error at the level of that name (any other text: an
/// error without one). Bodies are always judged, as in any scene of several.
std::vector<Level> levels_for(const std::string& level_name, bool self);

/// False for levels about the inside of a solid, which a part of a solid does not have.
bool can_be_reduced(const std::string& level);
/// @throws InputError when errors at that level cannot be reduced
void require_reducible(const std::string& level);

/// How far apart the first spurious pair of two bodies or triangles is (relative_gap); 0 for other
/// findings. What is nearer by far may be reported for another reason, rounding for one.
/// @pre `verdict`, which is on `candidate`, shows `finding`
double gap_of(const CaseCandidate& candidate, const ProbeVerdict& verdict, const Finding& finding);

/// Finds the first frame in which the detector (by canonical name) has the wanted error. `is_case`:
/// the task is a case of an earlier run, which names the bodies.
/// @throws InputError, one sentence, if there is none
Defect find_defect(Probe& probe, const std::string& detector, bool is_case,
                   const std::vector<ReductionTask>& tasks);

}  // namespace contactcheck::reduce
