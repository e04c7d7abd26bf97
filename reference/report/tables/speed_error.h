// Cost and errors of every detector: the points of the chart of speed against error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/report/tables/error_counts.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// The path of the chart's picture next to report.md. No picture of a family has that name.
inline constexpr const char* kSpeedErrorFile = "plots/speed_error.svg";

/// One detector over several scenes; the counts are sums over them.
struct SpeedErrorPoint : ErrorCounts {
  std::string detector;
  /// The timed question; times of different questions do not compare.
  Question question = Question::kTriangles;
  /// The level of the counts: the finest that the detector claims in every judged scene.
  Level level = Level::kTriangle;
  double ms = 0.0;  ///< per frame: map + update + query, the mean over all frames; positive
  TimedPart timed;
  /// The error by the chart's measure; in [0, 1].
  double error = 0.0;
  /// True if every faster point of the same question has more errors.
  bool on_front = false;
};

/// A detector without a point, and the reason in words.
struct LeftOut {
  std::string detector, why;
};

struct SpeedError {
  std::string scenes;  ///< in words: "all 8 scenes"
  std::vector<SpeedErrorPoint> points;
  std::vector<LeftOut> left_out;
};

/// What counts as a detector's error.
enum class ErrorMeasure { kWorse, kMissed, kSpurious };

/// The choices of one chart.
struct SpeedErrorChoice {
  std::size_t scenes = 0;           ///< place in SpeedErrorCharts::scenes
  std::optional<Level> level = {};  ///< none: the finest that each detector claims in all of them
  ErrorMeasure measure = ErrorMeasure::kWorse;
  bool cold = false;  ///< times after a sweep through the caches
};

/// All charts of a run; the Markdown report draws one of those that the HTML page offers.
class SpeedErrorCharts {
 public:
  /// `index` must outlive it.
  explicit SpeedErrorCharts(const results::Index& index);

  const std::vector<SceneChoice>& scenes() const { return scenes_; }
  /// The first choice of scenes that at most half of the detectors fall out of, compared with the
  /// best choice: a point needs every scene.
  std::size_t first() const;
  SpeedError chart(const SpeedErrorChoice& choice) const;

 private:
  const results::Index& index_;
  std::vector<SceneChoice> scenes_;
};

/// The chart that is shown first.
SpeedError speed_error(const results::Index& index);

/// "Not in the chart: a, b (not timed); c (nothing to judge)."; "" if all are in it.
std::string left_out_sentence(const SpeedError& chart);

/// Sets `on_front` of every point.
void mark_front(std::vector<SpeedErrorPoint>& points);

/// The points as a table.
const std::vector<Column>& speed_error_columns();
std::vector<std::string> speed_error_cells(const SpeedErrorPoint& point);
/// The cells that differ between the charts of one level.
std::string speed_error_time(const SpeedErrorPoint& point);

}  // namespace contactcheck::report
