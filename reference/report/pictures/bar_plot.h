// Lying bars as a picture: a row per detector, each with one lane of bars or several.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace contactcheck::report {

/// One bar. `words` describe it at a browser's pointer and for a screen reader.
struct BarPart {
  std::size_t series;  ///< index into BarChart::series; decides its colour
  double share;        ///< its length; in [0, 1]
  std::string words;
};

/// Bars of one lane lie end to end, in order.
using BarLane = std::vector<BarPart>;

struct BarRow {
  std::string name;
  std::vector<BarLane> lanes;  ///< beneath each other; every row of a chart has as many
  std::string words;           ///< to the right of its bars
};

struct BarChart {
  /// Linear, or as the chart of speed against error has errors: shares of 1 in 10,000 and of all
  /// are both seen, but lengths do not add up: lanes of one bar only.
  enum class Scale { kLinear, kErrors };

  std::string title;
  std::vector<std::string> series;  ///< at most kSeriesColours
  std::vector<BarRow> rows;
  std::string axis;  ///< what a length is
  Scale scale = Scale::kLinear;
  std::vector<std::string> foot;  ///< lines beneath
};

/// An SVG document; empty without rows.
/// @pre no more series than there are colours; see Scale
std::string bar_plot(const BarChart& chart);

}  // namespace contactcheck::report
