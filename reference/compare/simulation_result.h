// What a detector is worth inside a simulation, as plain data: the motion it drives and what a
// whole step costs with it. Fields `closed_loop` and `step_ms` of results.json.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reference/compare/run_result.h"

namespace contactcheck {

/// The motion that a detector drives, judged by the oracle on its own frames.
struct ClosedLoop {
  std::string error;  ///< not empty: why there is no motion (it diverged); the rest is then empty
  std::size_t steps = 0;                ///< of the simulation
  std::map<Level, LevelCounts> levels;  ///< the detector's answers on the frames that it drove
  Semantics semantics;
  /// Metres: the true distance of every pair of bodies that the detector reports in the last tenth
  /// of the frames (0 where they touch or sink in); none without such a pair.
  std::optional<double> hover_at_rest_max, hover_at_rest_mean;
  /// Metres: the deepest vertex inside another body, over all frames; none where no body is solid.
  std::optional<double> deepest_penetration;
  /// (highest total energy - energy at the start) / highest kinetic energy: above 0 response or
  /// integrator put energy in.
  std::optional<double> energy_gain;
  double last_speed = 0.0;  ///< m/s, root of the mean square over the mass: is it at rest?
  /// Pairs of bodies that leave a true contact on the other side: the direction between their
  /// centres has turned by more than 90 degrees since the last frame before that contact.
  std::size_t tunnelling_events = 0;
};

/// One repeat of whole steps, summed over the timed steps, milliseconds.
struct StepSum {
  double mss = 0.0, cell = 0.0, test = 0.0, response = 0.0;
  double total() const { return mss + cell + test + response; }
};

/// Whole simulation steps, timed in lockstep: every detector steps from the same recorded states.
struct StepTimes {
  std::size_t steps = 0;      ///< timed ones
  std::vector<StepSum> sums;  ///< per repeat; repeat r of all detectors ran together
  StepSum mean() const;       ///< milliseconds per step: medians over repeats
};

nlohmann::ordered_json to_json(const ClosedLoop& loop);
nlohmann::ordered_json to_json(const StepTimes& times);

}  // namespace contactcheck
