// Milliseconds per frame and phase of every detector, as means over scenes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/report/markdown_table.h"
#include "reference/report/scene_choice.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// One detector over the scenes in which it was timed, each counting the same. Milliseconds per
/// frame.
struct PhaseMeans {
  std::string detector;
  Question question = Question::kTriangles;  ///< its own; of different ones times do not compare
  std::size_t scenes = 0;                    ///< at least one
  /// None for a detector that maps what it needs within its query. Where it does so in some scenes
  /// alone, those count with 0.
  std::optional<double> map;
  double update = 0.0, query = 0.0;
  TimedPart timed;

  double without_map() const { return update + query; }
  double total() const { return map.value_or(0.0) + update + query; }
};

/// Of all detectors that were timed in one of these scenes, in playback or cold; the least total
/// first.
std::vector<PhaseMeans> phase_times(const results::Index& index, const SceneChoice& scenes,
                                    bool cold);

/// A row per detector, in this order.
TitledTable phase_times_table(const std::vector<PhaseMeans>& all);

}  // namespace contactcheck::report
