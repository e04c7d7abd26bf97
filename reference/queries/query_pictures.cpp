#include "reference/queries/query_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "reference/report/pictures/line_plot.h"
#include "reference/report/pictures/svg.h"

namespace contactcheck::queries {
namespace {

constexpr int kLeastDecade = -12, kLargestDecade = 5;

/// One detector in one decade, over all files.
struct Sum {
  std::uint64_t timed = 0, answered = 0;
  double early = 0, late = 0, micros = 0;
};

struct Series {
  std::string name;
  std::map<int, Sum> decades;
};

/// All detectors in the order in which they occur, as many as there are colours.
struct Decades {
  std::vector<Series> series;
  int least = kLargestDecade, largest = kLeastDecade;
  bool all_shown = true;
};

Decades by_decade(const std::vector<FileScore>& scores) {
  Decades decades;
  std::vector<Series>& all = decades.series;
  for (const FileScore& file : scores)
    for (const DetectorScore& d : file.detectors) {
      auto series = std::ranges::find(all, d.detector, &Series::name);
      if (series == all.end() && all.size() == report::kSeriesColours) continue;
      if (series == all.end()) series = all.insert(all.end(), {d.detector, {}});
      for (const DecadeScore& from : d.decades) {
        // Points have no length; one query of 1e300 m would squeeze all others into one place.
        if (!from.decade || *from.decade < kLeastDecade || *from.decade > kLargestDecade) {
          decades.all_shown = false;
          continue;
        }
        decades.least = std::min(decades.least, *from.decade);
        decades.largest = std::max(decades.largest, *from.decade);
        Sum& sum = series->decades[*from.decade];
        sum.timed += from.timed;
        sum.early = std::max(sum.early, from.early_max);
        sum.late = std::max(sum.late, from.late_max);
        sum.answered += from.answered;
        sum.micros += from.micros * static_cast<double>(from.answered);
      }
    }
  return decades;
}

/// The middle of a decade, metres.
double length_of(int decade) { return std::pow(10.0, decade + 0.5); }

/// A chart over these decades, without series.
report::LineChart chart_over(const Decades& decades, const std::string& title) {
  report::LineChart chart;
  chart.title = title;
  chart.x_axis = "longest edge at t = 0, metres";
  chart.from = std::pow(10.0, decades.least);
  chart.to = std::pow(10.0, decades.largest + 1);
  if (!decades.all_shown) chart.foot = {"Edges from 1e-12 to 1e6 m; queries.json has all."};
  return chart;
}

}  // namespace

std::string time_error_picture(const std::vector<FileScore>& scores) {
  const Decades decades = by_decade(scores);
  report::LineChart chart =
      chart_over(decades, "Time of contact: largest error by length of edges");
  chart.y_axis = "fraction of the step";
  chart.lowest = 1e-16;
  chart.foot.insert(chart.foot.begin(),
                    "Circles: early. Squares: late. 0: within the true interval, which has a width "
                    "of at most 2^-40.");
  for (std::size_t i = 0; i < decades.series.size(); ++i) {
    const Series& series = decades.series[i];
    report::LineSeries early{series.name, i, false, {}}, late{"", i, true, {}};
    for (const auto& [decade, sum] : series.decades) {
      if (sum.timed == 0) continue;
      early.points.push_back({length_of(decade), sum.early});
      late.points.push_back({length_of(decade), sum.late});
    }
    if (early.points.empty()) continue;
    chart.series.push_back(std::move(early));
    chart.series.push_back(std::move(late));
  }
  return report::line_plot(chart);
}

std::string cost_picture(const std::vector<FileScore>& scores) {
  const Decades decades = by_decade(scores);
  report::LineChart chart = chart_over(decades, "Cost by length of edges");
  chart.y_axis = "median microseconds a query";
  for (std::size_t i = 0; i < decades.series.size(); ++i) {
    report::LineSeries line{decades.series[i].name, i, false, {}};
    for (const auto& [decade, sum] : decades.series[i].decades)
      if (sum.answered > 0 && sum.micros > 0)
        line.points.push_back({length_of(decade), sum.micros / static_cast<double>(sum.answered)});
    if (!line.points.empty()) chart.series.push_back(std::move(line));
  }
  return report::line_plot(chart);
}

}  // namespace contactcheck::queries
