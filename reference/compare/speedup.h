// From raw time samples to times per frame and speed-ups with intervals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck {

/// Nanoseconds of one repeat of one frame.
struct PhaseSample {
  double map = 0.0, update = 0.0, query = 0.0;
  std::optional<double> reported = std::nullopt;  ///< of update and query, by the detector itself
  double total() const { return map + update + query; }
};

struct FrameSamples {
  std::vector<PhaseSample> cold, hot;  ///< one per repeat; repeat r of all detectors ran together
};

/// The samples of one detector and one question in one process.
struct QuestionSamples {
  Question question = Question::kTriangles;
  bool lazy_map = false;  ///< the detector maps what it needs itself: no phase `map`
  std::map<std::size_t, FrameSamples> frames;
};

/// One entry per fresh process; all hold the same frames.
using ProcessSamples = std::vector<QuestionSamples>;

/// @pre processes is not empty and holds at least one frame
results::QuestionTimes summarize_times(const ProcessSamples& processes,
                                       const std::vector<bool>& contact_frames);

/// Median over repeats per frame, cold, milliseconds; none of a frame that was not timed.
std::vector<std::optional<double>> cold_frame_ms(const ProcessSamples& processes,
                                                 std::size_t frames);

/// time(reference) / time(detector) over the frames both were timed on. The intervals
/// are bootstraps over processes and, within each, over repeats. None when the two share no timed
/// frame.
std::optional<results::Speedup> compute_speedup(const ProcessSamples& reference,
                                                const ProcessSamples& detector,
                                                const std::vector<bool>& contact_frames);

}  // namespace contactcheck
