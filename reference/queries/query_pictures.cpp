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

/// Of one detector and decade, over all files.
struct Sum {
  std::uint64_t timed = 0, answered = 0;
  double early = 0, late = 0, micros = 0;
};

struct Series {
  std::string name;
  std::map<int, Sum> decades;
};

/// In the order in which detectors occur, as many as there are colours.
std::vector<Series> by_decade(const std::vector<FileScore>& scores) {
  std::vector<Series> all;
  for (const FileScore& file : scores)
    for (const DetectorScore& d : file.detectors) {
      auto series = std::ranges::find(all, d.detector, &Series::name);
      if (series == all.end() && all.size() == report::kSeriesColours) continue;
      if (series == all.end()) series = all.insert(all.end(), {d.detector, {}});
      for (const DecadeScore& from : d.decades) {
        // Points have no length; one query of 1e300 m would squeeze all others into one place.
        if (!from.decade || *from.decade < kLeastDecade || *from.decade > kLargestDecade) continue;
        Sum& sum = series->decades[*from.decade];
        sum.timed += from.timed;
        sum.early = std::max(sum.early, from.early_max);
        sum.late = std::max(sum.late, from.late_max);
        sum.answered += from.answered;
        sum.micros += from.micros * static_cast<double>(from.answered);
      }
    }
  return all;
}

/// The middle of a decade, metres.
double length_of(int decade) { return std::pow(10.0, decade + 0.5); }

constexpr const char* kLength = "longest edge at t = 0, metres";
constexpr const char* kWhich = "Edges from 1e-12 to 1e6 m; queries.json has all.";

}  // namespace

std::string time_error_picture(const std::vector<FileScore>& scores) {
  report::LineChart chart;
  chart.title = "Time of contact: largest error by length of edges";
  chart.x_axis = kLength;
  chart.y_axis = "fraction of the step";
  chart.lowest = 1e-16;
  chart.foot = {
      "Solid: early. Dashed: late. 0: within the true interval, which has a width of at "
      "most 2^-40.",
      std::string("Of reported contacts with a time. ") + kWhich};
  std::size_t colour = 0;
  for (const Series& series : by_decade(scores)) {
    report::LineSeries early{series.name, colour, false, {}}, late{"", colour, true, {}};
    for (const auto& [decade, sum] : series.decades) {
      if (sum.timed == 0) continue;
      early.points.push_back({length_of(decade), sum.early});
      late.points.push_back({length_of(decade), sum.late});
    }
    if (!early.points.empty()) {
      chart.series.push_back(std::move(early));
      chart.series.push_back(std::move(late));
    }
    ++colour;
  }
  return report::line_plot(chart);
}

std::string cost_picture(const std::vector<FileScore>& scores) {
  report::LineChart chart;
  chart.title = "Cost by length of edges";
  chart.x_axis = kLength;
  chart.y_axis = "mean microseconds a query";
  chart.foot = {kWhich};
  std::size_t colour = 0;
  for (const Series& series : by_decade(scores)) {
    report::LineSeries line{series.name, colour++, false, {}};
    for (const auto& [decade, sum] : series.decades)
      if (sum.answered > 0 && sum.micros > 0)
        line.points.push_back({length_of(decade), sum.micros / static_cast<double>(sum.answered)});
    if (!line.points.empty()) chart.series.push_back(std::move(line));
  }
  return report::line_plot(chart);
}

}  // namespace contactcheck::queries
