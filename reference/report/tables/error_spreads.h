// How large the errors of detectors are, over several scenes: depths, normals, distances of
// spurious pairs, hover.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types/semantics.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// Errors from `from` on and below `below`.
struct ErrorBin {
  double from = 0.0, below = 0.0;
  std::uint64_t count = 0;
  double share = 0.0;  ///< of all errors of the row; in [0, 1]
};

/// One detector, whose depths are of one kind; numbers in the unit of the chart.
struct ErrorRow {
  std::string detector;
  DepthKind kind = DepthKind::kNone;
  std::uint64_t judged = 0;  ///< more than 0
  /// Over all that was judged where there is a mean, and of the worst scene; none for hover, of
  /// which there is too little.
  std::optional<double> mean, p95;
  double max = 0.0;  ///< of the worst scene; more than 0
  /// Small before large; empty where the results hold no histogram. Lengths below a micrometre are
  /// in one bin, and none ends behind the largest error of the chart, or two micrometres.
  std::vector<ErrorBin> bins;
  std::vector<double> points;  ///< where few are known one by one: hover
};

/// One quantity. Depths of each kind are separate quantities, since they do not compare.
struct ErrorChart {
  std::string title;  ///< "Depth, convex-pair"
  std::string axis, unit;
  std::string what;   ///< was judged: "contacts judged"
  std::string truth;  ///< a sentence: what errors are measured against; may be ""
  std::vector<ErrorRow> rows;
  std::string always_zero;  ///< "Always 0: a, b and c.": these have no row; may be ""
};

/// Of all quantities of which something was judged in these scenes.
std::vector<ErrorChart> error_charts(const results::Index& index, const SceneChoice& scenes);

}  // namespace contactcheck::report
