// Compares answers about steps with the ground truth.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/types/contact_set.h"
#include "reference/judge/judge.h"
#include "reference/judge/judged_scene.h"
#include "reference/oracle/step_distance.h"
#include "reference/oracle/step_truth.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// @pre `level` is one of contact within steps; both sets are canonical
LevelComparison compare_step_at(Level level, const ContactSet& truth, const ContactSet& reported);

/// What a scene's steps hold, without any detector. @pre the scene judges contact within steps
results::SceneImpacts scene_impacts(const JudgedScene& judged);

/// A detector's answers about the steps of a scene, beside what is counted at each level.
class StepSums {
 public:
  /// @pre the scene judges contact within steps
  StepSums(const JudgedScene& judged, const Semantics& semantics);

  /// What is said of a step, which compare() is then about. @pre canonical
  void begin(std::size_t step, const ContactSet& answer);
  /// A report that is not true counts as near or undecided instead of spurious where the declared
  /// tolerance excuses it. @pre between begin() and the next; a level of contact within steps
  LevelComparison compare(Level level, const ContactSet& answer);

  /// `at_start`, `at_end`: the pairs of bodies that it reports in the frames at both ends, which
  /// count where it does not answer about steps; `answer`: what it says of the step.
  /// @pre canonical; steps come in order
  void add(std::size_t step, const std::vector<BodyPair>& at_start,
           const std::vector<BodyPair>& at_end, const ContactSet& answer);

  results::Impacts sums;

 private:
  void add_times(const oracle::StepTruth& truth, const ContactSet& answer);

  const JudgedScene& judged_;
  bool of_steps_, of_triangles_;
  ImpactTolerance tolerance_;
  std::optional<oracle::StepDistances> distances_;  // with a tolerance above 0
  std::size_t step_ = 0;
};

}  // namespace contactcheck::judge
