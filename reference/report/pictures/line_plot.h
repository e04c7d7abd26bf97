// Numbers against a number, both on logarithmic axes, as a picture: a line for each series.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace contactcheck::report {

struct LinePoint {
  double x = 0, y = 0;
};

struct LineSeries {
  std::string name;               ///< in the legend; empty: it has none of its own
  std::size_t colour = 0;         ///< below kSeriesColours
  bool dashed = false;            ///< with squares, not circles, at its points
  std::vector<LinePoint> points;  ///< ascending; x above 0, y at least 0
};

struct LineChart {
  std::string title, x_axis, y_axis;
  std::vector<LineSeries> series;
  /// What is below it, 0 above all, lies on the lowest line, which is called "0".
  double lowest = 0;
  double from = 0, to = 0;        ///< of the axis across; 0: as the points have it
  std::vector<std::string> foot;  ///< lines beneath
};

/// An SVG document; empty without points.
std::string line_plot(const LineChart& chart);

}  // namespace contactcheck::report
