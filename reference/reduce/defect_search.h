// Finds the frame and the two bodies of which a detector's error is reduced.
#pragma once

#include <string>
#include <vector>

#include "reference/reduce/probe.h"
#include "reference/reduce/task.h"
#include "reference/reduce/verdict.h"

namespace contactcheck {

/// What is reduced: a frame of two bodies in which the detector was seen to err.
struct Defect {
  ReductionTask task;
  Finding finding;
};

/// "scene, frame 3": as a message begins.
std::string where(const ReductionTask& task);

/// At which levels answers are judged to see an error at the level of that name (any other text: an
/// error without one). Bodies are always judged, as in any scene.
std::vector<Level> levels_for(const std::string& level_name);

/// @throws InputError when errors at that level cannot be reduced
void require_reducible(const std::string& level);

class DefectSearch {
 public:
  /// `detector`: its canonical name. `is_case`: the task is a case of an earlier run, whose two
  /// bodies are known. `probe` must outlive this.
  DefectSearch(Probe& probe, std::string detector, bool is_case)
      : probe_(probe), detector_(std::move(detector)), is_case_(is_case) {}

  /// In the first frame in which the detector errs as it is looked for.
  /// @throws InputError, one sentence, where there is none, or where it needs more than two bodies
  Defect find(const std::vector<ReductionTask>& tasks);

 private:
  Defect defect_of(const ReductionTask& task, const ProbeVerdict& verdict, const Finding& finding);
  Snapshot bodies_of_error(const ReductionTask& task, const Finding& finding);
  Defect with_two_bodies(const Defect& defect);
  [[noreturn]] void refuse_more_bodies(const ReductionTask& task, const Finding& finding) const;
  [[noreturn]] void refuse_without_finding(const std::vector<ReductionTask>& tasks) const;
  std::string why_not_judged(const std::string& level) const;

  Probe& probe_;
  std::string detector_;
  bool is_case_;
  ProbeVerdict last_;
};

}  // namespace contactcheck
