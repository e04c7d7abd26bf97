#include "reference/report/pictures/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "reference/report/pictures/plot_axis.h"
#include "reference/report/pictures/svg.h"

namespace contactcheck::report {
namespace {
using Anchor = Svg::Anchor;

constexpr double kMargin = 16, kLetter = 7.0, kLine = 18, kHead = 26, kNumbers = 64, kKey = 24;
constexpr double kWidth = 560, kHeight = 260, kBelow = 46, kDot = 3;
constexpr double kPictureWidth = kMargin + kNumbers + kWidth + kMargin;

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

struct LegendEntry {
  const LineSeries* series;
  double x, y;
};

/// In as many lines as the width needs.
std::vector<LegendEntry> legend_of(const std::vector<LineSeries>& all) {
  std::vector<LegendEntry> legend;
  double x = kMargin, y = 40;
  for (const LineSeries& series : all) {
    if (series.name.empty()) continue;
    const double width = kKey + kLetter * static_cast<double>(series.name.size()) + 14;
    if (x > kMargin && x + width > kPictureWidth) {
      x = kMargin;
      y += kLine;
    }
    legend.push_back({&series, x, y});
    x += width;
  }
  return legend;
}

/// About its point.
std::string marker(bool square) {
  if (square) return fmt::format("M{0} {0}h{1}v{1}h-{1}Z", -kDot, 2 * kDot);
  return fmt::format("M{0} 0a{1} {1} 0 1 0 {2} 0a{1} {1} 0 1 0 -{2} 0", -kDot, kDot, 2 * kDot);
}

std::string css() {
  return series_css("stroke") + "path{fill:none;stroke-width:2}.dashed{stroke-dasharray:5 4}\n";
}

}  // namespace

std::string line_plot(const LineChart& chart) {
  Range across, up;
  for (const LineSeries& series : chart.series)
    for (const LinePoint& point : series.points) {
      across.add(point.x);
      up.add(std::max(point.y, chart.lowest));
    }
  if (across.most == 0) return "";
  if (chart.from > 0) across.add(chart.from);
  if (chart.to > 0) across.add(chart.to);
  const LogAxis x_axis(across.least, across.most);
  const LogAxis y_axis(chart.lowest > 0 ? chart.lowest : up.least, up.most);
  const std::vector<LegendEntry> legend = legend_of(chart.series);
  const double head = (legend.empty() ? 40.0 : legend.back().y) + kHead;
  const double left = kMargin + kNumbers, right = left + kWidth, bottom = head + kHeight;
  const auto x_of = [&](double x) { return left + kWidth * x_axis.place(x); };
  const auto y_of = [&](double y) {
    return bottom - kHeight * y_axis.place(std::max(y, chart.lowest));
  };
  Svg svg(kPictureWidth, bottom + kBelow + kLine * static_cast<double>(chart.foot.size()));

  svg.text(kMargin, 20, chart.title, Anchor::kStart, "title");
  for (const LegendEntry& entry : legend) {
    svg.path(entry.x, entry.y - 4, "M0 0h18", fmt::format("s{}", entry.series->colour));
    svg.text(entry.x + kKey, entry.y, entry.series->name);
  }

  for (const Tick& tick : x_axis.ticks()) {
    svg.line(x_of(tick.value), head, x_of(tick.value), bottom, "grid");
    svg.text(x_of(tick.value), bottom + 14, tick.name, Anchor::kMiddle, "faint");
  }
  for (const Tick& tick : y_axis.ticks()) {
    if (tick.value <= chart.lowest) continue;
    svg.line(left, y_of(tick.value), right, y_of(tick.value), "grid");
    svg.text(left - 8, y_of(tick.value) + 4, tick.name, Anchor::kEnd, "faint");
  }
  if (chart.lowest > 0) {
    svg.line(left, y_of(0), right, y_of(0), "grid");
    svg.text(left - 8, y_of(0) + 4, "0", Anchor::kEnd, "faint");
  }
  svg.text(right, bottom + 31, chart.x_axis, Anchor::kEnd);
  svg.text(kMargin, head - 8, chart.y_axis);

  for (const LineSeries& series : chart.series) {
    std::string outline;
    for (const LinePoint& point : series.points)
      outline +=
          fmt::format("{}{:.1f} {:.1f}", outline.empty() ? "M" : "L", x_of(point.x), y_of(point.y));
    const std::string colour = fmt::format("s{}", series.colour);
    if (series.points.size() > 1)
      svg.path(0, 0, outline, colour + (series.dashed ? " dashed" : ""));
    for (const LinePoint& point : series.points)
      svg.path(x_of(point.x), y_of(point.y), marker(series.dashed), colour);
  }
  double foot_y = bottom + kBelow + 4;
  for (const std::string& line : chart.foot) {
    svg.text(kMargin, foot_y, line, Anchor::kStart, "faint");
    foot_y += kLine;
  }
  return svg.document(chart.title, css());
}

}  // namespace contactcheck::report
