// The judged result of one detector on one scene, as plain data. results.json is written from it
// (run_result_json.h); design.md, "results.json", gives each field's meaning.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/count.h"
#include "core/types/semantics.h"
#include "reference/compare/histogram.h"
#include "reference/statistics/statistics.h"

namespace contactcheck {

enum class RunStatus { kOk, kError, kAbsent, kRefused };
const char* name_of(RunStatus status);

/// Sums over frames. recall = hit / truth and spurious rate = spurious / reported; a rate over
/// nothing has no value.
struct LevelCounts {
  std::uint64_t truth = 0, reported = 0, hit = 0, missed = 0, spurious = 0;

  std::optional<double> recall() const;
  std::optional<double> spurious_rate() const;
  LevelCounts& operator+=(const LevelCounts& other);
  bool perfect() const { return missed == 0 && spurious == 0; }
};

/// One line per frame, at the finest level claimed and judged.
struct PerFrame {
  std::string level;
  std::vector<std::uint64_t> truth, missed, spurious;
  /// The share of the true contact contour that the report covers; none in frames without contour
  /// and for detectors that report no elements.
  std::vector<std::optional<double>> covered_length_fraction;
};

/// How many of a frame's pairs there are, and the first of them in canonical order.
struct ListedPairs {
  std::uint64_t count = 0;
  std::vector<ElementPair> pairs;
};

/// What a frame's answer lacks and what it has too much, at the level of PerFrame. The elements of
/// a pair are those that the level counts: missed at level `cell` are triangles; a level of bodies
/// has none, and of `vertex` only the first is one (what is none is 0).
struct FrameDifferences {
  std::size_t frame = 0;
  ListedPairs missed, spurious;
};

/// Errors over all contacts that could be judged; values only where there was one.
struct ErrorSpread {
  std::size_t judged = 0;
  std::optional<double> max, mean, p95;
  std::vector<HistogramBin> histogram = {};
};

/// Graded errors: pair counts depend on tessellation, these do not.
struct GradedErrors {
  std::optional<double> missed_length;            ///< metres of contour, summed over frames
  std::optional<double> covered_length_fraction;  ///< of the contour of all frames
  std::optional<double> spurious_distance_max;    ///< metres; of spurious triangle pairs
  std::vector<HistogramBin> spurious_distances;   ///< metres, all of them
  ErrorSpread depth;                              ///< metres, |reported - true|
  ErrorSpread normal_deg;                         ///< degrees, to the nearest of the true ways out
};

struct StageResult {
  std::string name, unit;
  std::uint64_t in = 0, out = 0, missed = 0;
  std::uint64_t visited = 0;
  std::string visited_unit;  ///< empty: the stage does not count what it visits
};

/// A stretch of frames in which two bodies touch or are said to.
struct Episode {
  BodyPair bodies;
  std::optional<std::size_t> first_true, first_reported;  ///< frames
  std::optional<double> hover_gap;                        ///< metres
  std::optional<long> late_frames;                        ///< reported minus true, signed
};

struct PhaseTimes {
  std::optional<double> map;  ///< none for detectors that map what they need themselves
  double update = 0.0, query = 0.0, frame = 0.0;
  std::optional<double> contact_frame;  ///< mean over timed contact frames
  std::optional<double> self_reported;  ///< update and query, by the detector's own clock
};

/// Milliseconds per frame: medians over repeats, averaged over the timed frames.
struct QuestionTimes {
  Question question = Question::kTriangles;
  std::size_t timed_frames = 0, timed_contact_frames = 0, repeats = 0;
  PhaseTimes cold, hot;
};

/// time(reference) / time(detector) over the same frames.
struct Speedup {
  Ratio cold, hot;
  std::optional<Ratio> contact_frames;  ///< cold; none without a timed contact frame
  std::optional<Ratio> without_map;     ///< cold; none when one side maps lazily
};

/// The timed part of a result; pooled by the parent from all worker processes.
struct RunTimes {
  std::vector<QuestionTimes> questions;         ///< the detector's own question first
  std::map<std::size_t, double> cold_frame_ms;  ///< of that question, by frame; only timed frames
  std::map<Question, std::map<std::string, Speedup>> speedups;  ///< by reference detector
};

struct Disagreement {
  std::string scene, detector, level, kind, case_file;
  std::size_t frame = 0;
  ElementPair pair;
};

struct RunResult {
  std::string scene, detector, message;
  RunStatus status = RunStatus::kOk;
  std::optional<std::size_t> failed_frame;  ///< of an error, where it is known
  std::size_t frames = 0, contact_frames = 0;
  Semantics semantics;
  std::map<std::string, std::string> options;
  std::string recording;
  PerFrame per_frame;
  std::vector<FrameDifferences> differences;  ///< frames that have any; where pairs are listed
  std::map<Level, LevelCounts> levels;
  std::map<Level, LevelCounts> levels_rounded;  ///< against the truth of the values it was fed
  std::map<Level, std::string> not_judged;      ///< claimed, but why not judged
  GradedErrors graded;
  std::vector<Episode> episodes;
  std::vector<StageResult> stages;
  /// What the detector says it did for its own question, summed over frames; in its own units.
  std::vector<Count> counters;
  double prepare_ms = 0.0;
  std::uint64_t memory_bytes = 0;
  std::uint64_t contact_hash = 0;
  std::vector<std::string> float_environment;  ///< what the detector left changed
  std::vector<std::string> notes;              ///< what else a reader must know
  std::vector<Disagreement> disagreements;

  /// The largest hover gap and the late_frames of largest size over all episodes.
  std::optional<double> hover_gap_max() const;
  std::optional<long> late_frames_worst() const;
};

}  // namespace contactcheck
