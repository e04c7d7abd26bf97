#include "reference/report/pictures/bar_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/types/check.h"
#include "reference/report/pictures/plot_axis.h"
#include "reference/report/pictures/svg.h"

namespace contactcheck::report {
namespace {
using Anchor = Svg::Anchor;

constexpr double kMargin = 16, kLetter = 7.0, kBars = 380, kLine = 18, kHead = 52;
constexpr double kLane = 9, kLaneGap = 1, kRowGap = 9, kAxis = 46;
constexpr double kThinnest = 1.5;  // one wrong contact of a million must still be seen

double width_of(const std::string& words) { return kLetter * static_cast<double>(words.size()); }

/// From 0 to the next of 1, 2 and 5 times a power of ten; in percent.
class LinearAxis {
 public:
  explicit LinearAxis(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(most, 1e-12))));
    for (const double digit : {1.0, 2.0, 5.0, 10.0}) {
      top_ = digit * power;
      if (top_ >= most) break;
    }
  }
  double place(double share) const { return share / top_; }
  std::vector<Tick> ticks() const {
    std::vector<Tick> ticks;
    for (int i = 0; i <= 4; ++i)
      ticks.push_back({top_ * i / 4, fmt::format("{:.3g} %", 100.0 * top_ * i / 4)});
    return ticks;
  }

 private:
  double top_ = 1.0;
};

}  // namespace

std::string bar_plot(const BarChart& chart) {
  CONTACTCHECK_INVARIANT(chart.series.size() <= kSeriesColours, "a colour for each series");
  if (chart.rows.empty()) return "";

  double names = 0.0, words = 0.0, longest = 0.0;
  for (const BarRow& row : chart.rows) {
    names = std::max(names, width_of(row.name));
    words = std::max(words, width_of(row.words));
    for (const BarLane& lane : row.lanes) {
      double sum = 0.0;
      for (const BarPart& part : lane) sum += part.share;
      longest = std::max(longest, sum);
    }
  }
  double lines = width_of(chart.title), legend_end = kMargin;
  for (const std::string& line : chart.foot) lines = std::max(lines, width_of(line));
  const auto legend_width = [](const std::string& name) { return 16 + width_of(name) + 12; };
  for (const std::string& name : chart.series) legend_end += legend_width(name);

  const double left = kMargin + names + 8, right = left + kBars;
  const double width = std::max({right + 12 + words, lines + kMargin, legend_end}) + kMargin;
  const double lanes_height =
      static_cast<double>(chart.rows.front().lanes.size()) * (kLane + kLaneGap);
  const auto y_of = [&](std::size_t row) {
    return kHead + kRowGap / 2 + static_cast<double>(row) * (lanes_height + kRowGap);
  };
  const double bottom = y_of(chart.rows.size());
  const bool errors = chart.scale == BarChart::Scale::kErrors;
  const ErrorAxis error_axis(std::min(1.0, longest));
  const LinearAxis linear_axis(longest);
  const auto x_of = [&](double share) {
    return left + kBars * (errors ? error_axis.place(share) : linear_axis.place(share));
  };
  Svg svg(width, bottom + kAxis + kLine * static_cast<double>(chart.foot.size()));

  svg.text(kMargin, 20, chart.title, Anchor::kStart, "title");
  double legend_x = kMargin;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    svg.rectangle(legend_x, 30, 11, 11, fmt::format("s{}", s));
    svg.text(legend_x + 16, 40, chart.series[s]);
    legend_x += legend_width(chart.series[s]);
  }

  for (const Tick& tick : errors ? error_axis.ticks() : linear_axis.ticks()) {
    svg.line(x_of(tick.value), kHead, x_of(tick.value), bottom, "grid");
    svg.text(x_of(tick.value), bottom + 14, tick.name, Anchor::kMiddle, "faint");
  }
  svg.text(right, bottom + 31, chart.axis, Anchor::kEnd);

  for (std::size_t r = 0; r < chart.rows.size(); ++r) {
    const BarRow& row = chart.rows[r];
    const double middle = y_of(r) + lanes_height / 2 + 4;
    svg.text(left - 8, middle, row.name, Anchor::kEnd);
    double y = y_of(r);
    for (const BarLane& lane : row.lanes) {
      double before = 0.0, x = left;
      for (const BarPart& part : lane) {
        if (part.share <= 0.0) continue;
        const double end = std::max(x_of(before + part.share), x + kThinnest);
        svg.begin_group(part.words);
        svg.rectangle(x, y, end - x, kLane, fmt::format("s{}", part.series));
        svg.end_group();
        before += part.share;
        x = end;
      }
      y += kLane + kLaneGap;
    }
    svg.text(right + 12, middle, row.words, Anchor::kStart, "faint");
  }

  double foot_y = bottom + kAxis + 4;
  for (const std::string& line : chart.foot) {
    svg.text(kMargin, foot_y, line, Anchor::kStart, "faint");
    foot_y += kLine;
  }
  return svg.document(chart.title, series_css("fill"));
}

}  // namespace contactcheck::report
