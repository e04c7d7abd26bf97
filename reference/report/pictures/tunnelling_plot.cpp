#include "reference/report/pictures/tunnelling_plot.h"

#include <algorithm>

#include "reference/report/pictures/line_plot.h"
#include "reference/report/pictures/svg.h"
#include "reference/text/lists.h"

namespace contactcheck::report {

std::string tunnelling_plot(const std::vector<TunnellingLine>& lines) {
  // A thousandth of the pairs is more than most scenes have.
  constexpr double kLeastShare = 1e-3;
  LineChart chart;
  chart.title = "Contacts between frames that pass unseen";
  chart.x_axis = "largest motion in a step, mean edges \u2192";
  chart.y_axis = "\u2191 share of pairs of bodies that meet within a step";
  chart.lowest = kLeastShare;
  for (std::size_t i = 0; i < std::min(lines.size(), kSeriesColours); ++i) {
    LineSeries series{text::joined(lines[i].detectors), i, i % 2 == 1, {}};
    for (const TunnellingPoint& point : lines[i].points)
      series.points.push_back({point.motion, point.share});
    chart.series.push_back(std::move(series));
  }
  return line_plot(chart);
}

}  // namespace contactcheck::report
