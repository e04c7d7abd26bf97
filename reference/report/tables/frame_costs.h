// The cost of frames for each detector: by phase, as means over scenes; frame by frame in a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// One detector over the scenes in which it was timed, each with equal weight. Milliseconds per
/// frame.
struct PhaseMeans {
  std::string detector;
  Question question = Question::kTriangles;  ///< its own; times compare only within a question
  std::size_t scenes = 0;                    ///< at least one
  /// None for a detector that maps within its query. If it does so only in some scenes, these count
  /// as 0.
  std::optional<double> map;
  double update = 0.0, query = 0.0;
  TimedPart timed;

  double without_map() const { return update + query; }
  double total() const { return map.value_or(0.0) + update + query; }
};

/// The means of all detectors that were timed in one of these scenes, in playback or cold; sorted
/// by total, the least first.
std::vector<PhaseMeans> phase_times(const results::Index& index, const SceneChoice& scenes,
                                    bool cold);

/// One row per detector, in this order.
TitledTable phase_times_table(const std::vector<PhaseMeans>& all);

/// The cost of frames in which surfaces touch; milliseconds, playback.
struct TouchingCost {
  double low = 0.0, median = 0.0, high = 0.0;
  std::size_t frames = 0;
};

/// The costs of a row that is `ok`.
struct DetectorCosts {
  std::string detector;
  std::optional<double> playback, cold;  ///< milliseconds per frame; none: not timed
  /// By frame, playback; none for frames that were not timed. Empty if no frame was.
  std::vector<std::optional<double>> frame_ms;
  /// Frames with errors, with their number, at the finest level that the detector claims.
  std::vector<std::pair<std::size_t, std::uint64_t>> missed, spurious;
  /// (distance in millimetres, milliseconds), near before far: medians over timed frames at about
  /// the same distance, since single frames scatter.
  std::vector<std::pair<double, double>> by_distance;
  std::optional<TouchingCost> touching;  ///< none where no timed frame touches
};

struct SceneCosts {
  /// The common name of scenes that differ in size: "contact" for scaling-contact-4 and contact.
  std::string series;
  std::size_t triangles = 0;  ///< of all bodies
  /// True contacts by frame, at the level with the most.
  std::vector<std::uint64_t> truth;
  /// The smallest distance between surfaces of two bodies by frame, millimetres; empty if unknown.
  std::vector<double> distance;
  std::vector<DetectorCosts> detectors;
};

/// @pre `scene` is one of those of `index`
SceneCosts scene_costs(const results::Index& index, const results::Scene& scene);

}  // namespace contactcheck::report
