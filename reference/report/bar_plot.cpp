#include "reference/report/bar_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/types/check.h"
#include "reference/report/plot_axis.h"
#include "reference/report/svg.h"

namespace contactcheck::report {
namespace {
using Anchor = Svg::Anchor;

constexpr double kMargin = 16, kLetter = 7.0, kBars = 380, kLine = 18, kHead = 52;
constexpr double kLane = 9, kLaneGap = 1, kRowGap = 9, kAxis = 46;
constexpr double kThinnest = 1.5;  // one wrong contact of a million must still be seen

struct Colour {
  const char* light;
  const char* dark;
};
// Neighbours in the order differ in lightness too, for eyes that tell no colours apart.
constexpr Colour kColours[kBarSeries] = {
    {"#0b62c4", "#58a6ff"}, {"#d9730d", "#f0a050"}, {"#00695c", "#2fb39f"}, {"#b0568c", "#e39bc6"},
    {"#6e4a00", "#a88a3c"}, {"#5ab4d6", "#9fdcf2"}, {"#a12622", "#e5716d"}, {"#7a828a", "#aab2ba"}};

std::string style() {
  std::string light = ".grid{stroke:#d1d9e0}.faint{fill:#59636e}\n", dark;
  dark = ".grid{stroke:#3a424c}.faint{fill:#9aa5b1}\n";
  for (std::size_t s = 0; s < kBarSeries; ++s) {
    light += fmt::format(".s{}{{fill:{}}}", s, kColours[s].light);
    dark += fmt::format(".s{}{{fill:{}}}", s, kColours[s].dark);
  }
  return light + "\n@media(prefers-color-scheme:dark){" + dark + "}\n";
}

double width_of(const std::string& words) { return kLetter * static_cast<double>(words.size()); }

double longest_lane(const BarChart& chart) {
  double longest = 0.0;
  for (const BarRow& row : chart.rows)
    for (const BarLane& lane : row.lanes) {
      double sum = 0.0;
      for (const BarPart& part : lane) sum += part.share;
      longest = std::max(longest, sum);
    }
  return longest;
}

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

class BarPlot {
 public:
  explicit BarPlot(const BarChart& chart)
      : chart_(chart),
        errors_(std::min(1.0, longest_lane(chart))),
        linear_(longest_lane(chart)),
        left_(kMargin + name_width()),
        svg_(width(), bottom() + kAxis + kLine * static_cast<double>(chart.foot.size())) {}

  std::string draw() {
    svg_.text(kMargin, 20, chart_.title, Anchor::kStart, "title");
    draw_legend();
    draw_axis();
    for (std::size_t row = 0; row < chart_.rows.size(); ++row) draw_row(row);
    double y = bottom() + kAxis + 4;
    for (const std::string& line : chart_.foot) {
      svg_.text(kMargin, y, line, Anchor::kStart, "faint");
      y += kLine;
    }
    return svg_.document(chart_.title, style());
  }

 private:
  double name_width() const {
    double widest = 0.0;
    for (const BarRow& row : chart_.rows) widest = std::max(widest, width_of(row.name));
    return widest + 8;
  }
  double width() const {
    double words = 0.0, foot = width_of(chart_.title);
    for (const BarRow& row : chart_.rows) words = std::max(words, width_of(row.words));
    for (const std::string& line : chart_.foot) foot = std::max(foot, width_of(line));
    return std::max({left_ + kBars + 12 + words, foot + kMargin, legend_end()}) + kMargin;
  }
  static double legend_width(const std::string& name) { return 16 + width_of(name) + 12; }
  double legend_end() const {
    double x = kMargin;
    for (const std::string& name : chart_.series) x += legend_width(name);
    return x;
  }
  double row_height() const {
    return static_cast<double>(chart_.rows.front().lanes.size()) * (kLane + kLaneGap) + kRowGap;
  }
  double y_of(std::size_t row) const {
    return kHead + kRowGap / 2 + static_cast<double>(row) * row_height();
  }
  double bottom() const { return y_of(chart_.rows.size()); }
  double x_of(double share) const {
    const bool errors = chart_.scale == BarChart::Scale::kErrors;
    return left_ + kBars * (errors ? errors_.place(share) : linear_.place(share));
  }

  void draw_legend() {
    double x = kMargin;
    for (std::size_t s = 0; s < chart_.series.size(); ++s) {
      svg_.rectangle(x, 30, 11, 11, fmt::format("s{}", s));
      svg_.text(x + 16, 40, chart_.series[s]);
      x += legend_width(chart_.series[s]);
    }
  }

  void draw_axis() {
    const bool errors = chart_.scale == BarChart::Scale::kErrors;
    for (const Tick& tick : errors ? errors_.ticks() : linear_.ticks()) {
      svg_.line(x_of(tick.value), kHead, x_of(tick.value), bottom(), "grid");
      svg_.text(x_of(tick.value), bottom() + 14, tick.name, Anchor::kMiddle, "faint");
    }
    svg_.text(left_ + kBars, bottom() + 31, chart_.axis, Anchor::kEnd);
  }

  void draw_row(std::size_t index) {
    const BarRow& row = chart_.rows[index];
    const double middle = y_of(index) + (row_height() - kRowGap) / 2 + 4;
    svg_.text(left_ - 8, middle, row.name, Anchor::kEnd);
    double y = y_of(index);
    for (const BarLane& lane : row.lanes) {
      draw_lane(lane, y);
      y += kLane + kLaneGap;
    }
    svg_.text(left_ + kBars + 12, middle, row.words, Anchor::kStart, "faint");
  }

  void draw_lane(const BarLane& lane, double y) {
    double before = 0.0, x = left_;
    for (const BarPart& part : lane) {
      if (part.share <= 0.0) continue;
      const double end = std::max(x_of(before + part.share), x + kThinnest);
      svg_.begin_group(part.words);
      svg_.rectangle(x, y, end - x, kLane, fmt::format("s{}", part.series));
      svg_.end_group();
      before += part.share;
      x = end;
    }
  }

  const BarChart& chart_;
  ErrorAxis errors_;
  LinearAxis linear_;
  double left_;
  Svg svg_;
};

}  // namespace

std::string bar_plot(const BarChart& chart) {
  CONTACTCHECK_INVARIANT(chart.series.size() <= kBarSeries, "a colour for each series");
  return chart.rows.empty() ? "" : BarPlot(chart).draw();
}

}  // namespace contactcheck::report
