// The sizes of detectors' errors over several scenes: depths, normals, distances of spurious pairs,
// hover gaps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types/semantics.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// Errors in [from, below).
struct ErrorBin {
  double from = 0.0, below = 0.0;
  std::uint64_t count = 0;
  double share = 0.0;  ///< of all errors of the row; in [0, 1]
};

/// One detector with depths of one kind; numbers are in the unit of the chart.
struct ErrorRow {
  std::string detector;
  DepthKind kind = DepthKind::kNone;
  std::uint64_t judged = 0;  ///< more than 0
  /// mean is over all that was judged, p95 that of the worst scene; none for hover, which has too
  /// few values.
  std::optional<double> mean, p95;
  double max = 0.0;  ///< of the worst scene; above 0
  /// Small before large; empty without a histogram. Lengths below a micrometre share one bin; no
  /// bin ends above the largest error of the chart, or two micrometres.
  std::vector<ErrorBin> bins;
  std::vector<double> points;  ///< the few single values: hover
};

/// One quantity. Each kind of depth is a separate quantity, since the kinds do not compare.
struct ErrorChart {
  std::string title;  ///< "Depth, convex-pair"
  std::string axis, unit;
  std::string what;   ///< the judged things: "contacts judged"
  std::string truth;  ///< what errors are measured against, a sentence; may be ""
  std::vector<ErrorRow> rows;
  std::string always_zero;  ///< "Always 0: a, b and c.", detectors without a row; may be ""
};

/// The charts of all quantities that were judged in these scenes.
std::vector<ErrorChart> error_charts(const results::Index& index, const SceneChoice& scenes);

}  // namespace contactcheck::report
