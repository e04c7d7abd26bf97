// From raw time samples to times per frame and speed-ups with intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::timing {

/// Nanoseconds of one frame, by the wall clock, without what the machine has taken away from a
/// detector that was ready to run (cpu_time.h).
struct PhaseSample {
  double map = 0.0, update = 0.0, query = 0.0;
  std::optional<double> reported = std::nullopt;  ///< of update and query, by the detector itself
  double cpu = 0.0;                               ///< CPU time of the whole process tree
  double taken = 0.0;  ///< that the machine gave to others meanwhile; not in the other times
  double total() const { return map + update + query; }
};

/// What one detector took in one pass in one question, frame after frame, in a fresh process.
using Pass = std::vector<PhaseSample>;

/// The frames that the means of a playback are over: all but the first, where memory is not there
/// yet, unless there is no other. @pre frames > 0
std::vector<std::size_t> played_frames(std::size_t frames);

/// The samples of one detector and one question.
struct QuestionSamples {
  Question question = Question::kTriangles;
  bool lazy_map = false;  ///< the detector maps what it needs itself: no phase `map`
  /// By process, at least one; pass p of all detectors ran beside one another.
  std::vector<Pass> playback;
  std::vector<Pass> cold;  ///< over the cold frames alone; empty: another one's question
};

/// Which frames, or steps, a question's samples are of, and which of them have contact.
struct TimedFrames {
  std::vector<bool> contact;      ///< by frame, or step, of the scene
  std::vector<std::size_t> cold;  ///< of these, ascending
};

/// The cold frames of a scene at which a step begins: those of questions of steps.
std::vector<std::size_t> cold_steps(std::vector<std::size_t> cold_frames, std::size_t steps);

/// @pre every pass has all frames
results::QuestionTimes summarize_times(const QuestionSamples& samples, const TimedFrames& frames);

/// Per frame the median over passes, milliseconds, in playback.
std::vector<std::optional<double>> frame_ms(const QuestionSamples& samples);

/// time(reference) / time(detector), pass by pass, over as many passes of both.
/// @pre both of the same question and of all frames
results::Speedup compute_speedup(const QuestionSamples& reference, const QuestionSamples& detector,
                                 const TimedFrames& frames);

}  // namespace contactcheck::timing
