// What every detector costs and how often it errs: the points of the chart of speed against error.
#pragma once

#include <string>
#include <vector>

#include "reference/report/error_counts.h"
#include "reference/results/results.h"

namespace contactcheck {

/// One detector over several scenes; the counts are sums over them.
struct SpeedErrorPoint : ErrorCounts {
  std::string detector;
  /// That was timed; times of different questions do not compare.
  Question question = Question::kTriangles;
  /// Of the counts: the finest that the detector claims in every scene that was judged.
  Level level = Level::kTriangle;
  double ms = 0.0;  ///< per frame: map + update + query, cold, the mean over all frames; positive
  /// worse_share(); in [0, 1].
  double error = 0.0;
  /// No other point of the same question is faster without being worse.
  bool on_front = false;
};

/// A detector without a point. `why`, in words.
struct LeftOut {
  std::string detector, why;
};

struct SpeedError {
  std::string scenes;  ///< in words: "all 8 scenes"
  std::vector<SpeedErrorPoint> points;
  std::vector<LeftOut> left_out;
};

/// As the HTML report shows it at first (reference/report/web/src/pareto.ts), so that both are the
/// same picture: all scenes where most detectors ran well in all of them, else all families of hard
/// cases, else one scene. Detectors are in the order of their first runs.
SpeedError speed_error(const results::Results& results);

/// Sets `on_front` of every point.
void mark_front(std::vector<SpeedErrorPoint>& points);

}  // namespace contactcheck
