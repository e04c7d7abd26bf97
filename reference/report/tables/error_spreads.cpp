#include "reference/report/tables/error_spreads.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/report/tables/format.h"

namespace contactcheck::report {
namespace {
using results::ErrorSpread, results::Geometry, results::HistogramBin, results::Run;

constexpr double kMicrometre = 1e-3;  // of charts of lengths, which are in millimetres

/// What one run says of one quantity, in the unit of the results.
struct RunErrors {
  ErrorSpread spread;
  std::vector<double> points;
};

RunErrors depth_errors(const Geometry& geometry) { return {geometry.depth, {}}; }

RunErrors normal_errors(const Geometry& geometry) { return {geometry.normal_deg, {}}; }

RunErrors spurious_distances(const Geometry& geometry) {
  RunErrors out;
  out.spread.max = geometry.spurious_distance_max;
  out.spread.histogram = geometry.spurious_distance_histogram;
  for (const HistogramBin& bin : out.spread.histogram) out.spread.judged += bin.count;
  return out;
}

// One error per episode; a mean or a 95 % of a handful would say little.
RunErrors hover_errors(const Geometry& geometry) {
  RunErrors out;
  for (const results::Episode& episode : geometry.episodes)
    if (episode.hover_gap) out.points.push_back(*episode.hover_gap);
  out.spread.judged = out.points.size();
  if (!out.points.empty()) out.spread.max = *std::max_element(out.points.begin(), out.points.end());
  return out;
}

struct Quantity {
  const char *title, *axis, *what, *truth;
  bool length;   // in metres, drawn in millimetres; else degrees
  bool by_kind;  // of depth: kinds that do not compare have charts of their own
  RunErrors (*of)(const Geometry& geometry);
};

constexpr Quantity kQuantities[] = {
    {"Depth", "error of the depth, mm", "contacts judged",
     "The true depth is the shortest translation that separates two convex pieces (convex-pair), "
     "or "
     "the distance of a vertex inside a body to its surface (vertex-surface).",
     true, true, depth_errors},
    {"Normal", "error of the normal, degrees", "contacts judged",
     "The true normal is the direction of the shortest translation that separates two convex "
     "pieces, or the offset from a vertex to the nearest point of the surface; of several that are "
     "equally short the one "
     "nearest to what was reported counts.",
     false, false, normal_errors},
    {"Distance of spurious pairs of triangles", "true distance of pairs reported as touching, mm",
     "spurious pairs", "", true, false, spurious_distances},
    {"Hover", "true distance at the first report of contact, mm", "episodes of contact", "", true,
     false, hover_errors}};

using BinSums = std::map<double, HistogramBin>;  // by `from`, in the unit of the results

// Bins below a micrometre would be hairs in the chart.
std::vector<ErrorBin> bins_of(const BinSums& sums, const Quantity& quantity, double factor,
                              std::uint64_t judged) {
  std::vector<ErrorBin> bins;
  ErrorBin small{0.0, kMicrometre};
  for (const auto& [from, bin] : sums) {
    if (quantity.length && factor * bin.below <= kMicrometre) {
      small.count += bin.count;
    } else {
      bins.push_back({factor * from, factor * bin.below, bin.count});
    }
  }
  if (small.count > 0) bins.insert(bins.begin(), small);
  for (ErrorBin& bin : bins)
    bin.share = static_cast<double>(bin.count) / static_cast<double>(judged);
  return bins;
}

// None where nothing was judged.
std::optional<ErrorRow> row_of(const std::string& detector, const std::vector<const Run*>& runs,
                               const Quantity& quantity) {
  const double factor = quantity.length ? 1e3 : 1.0;
  ErrorRow row;
  row.detector = detector;
  double sum = 0.0, weight = 0.0;  // of the mean
  BinSums bins;
  for (const Run* run : runs) {
    const RunErrors errors = quantity.of(run->geometry);
    const ErrorSpread& spread = errors.spread;
    if (spread.judged == 0 || !spread.max) continue;
    row.kind = run->geometry.depth_kind;
    row.judged += spread.judged;
    if (spread.mean) {
      sum += factor * *spread.mean * static_cast<double>(spread.judged);
      weight += static_cast<double>(spread.judged);
    }
    if (spread.p95) row.p95 = std::max(row.p95.value_or(0.0), factor * *spread.p95);
    row.max = std::max(row.max, factor * *spread.max);
    for (const HistogramBin& bin : spread.histogram) {
      const auto [own, first] = bins.try_emplace(bin.from, bin);
      if (!first) own->second.count += bin.count;
    }
    for (const double point : errors.points) row.points.push_back(factor * point);
  }
  if (row.judged == 0) return {};
  if (weight > 0.0) row.mean = sum / weight;
  row.bins = bins_of(bins, quantity, factor, row.judged);
  return row;
}

// The chart of a title among those of one quantity.
ErrorChart& chart_of(std::vector<ErrorChart>& charts, const std::string& title,
                     const Quantity& quantity) {
  const auto own = std::find_if(charts.begin(), charts.end(),
                                [&](const ErrorChart& chart) { return chart.title == title; });
  if (own != charts.end()) return *own;
  charts.push_back({title,
                    quantity.axis,
                    quantity.length ? "mm" : "\u00b0",
                    quantity.what,
                    quantity.truth,
                    {},
                    ""});
  return charts.back();
}

}  // namespace

std::vector<ErrorChart> error_charts(const results::Index& index, const SceneChoice& scenes) {
  std::vector<ErrorChart> charts;
  for (const Quantity& quantity : kQuantities)
    for (const std::string& detector : index.detectors()) {
      std::optional<ErrorRow> row = row_of(detector, ok_runs(index, detector, scenes), quantity);
      if (!row) continue;
      const std::string title = quantity.by_kind
                                    ? std::string(quantity.title) + ", " + name_of(row->kind)
                                    : quantity.title;
      chart_of(charts, title, quantity).rows.push_back(std::move(*row));
    }
  for (ErrorChart& chart : charts) {
    std::vector<std::string> always_zero;
    double end = 2.0 * kMicrometre;
    for (const ErrorRow& row : chart.rows) {
      if (row.max == 0.0) always_zero.push_back(row.detector);
      end = std::max(end, row.max);
    }
    // A row whose largest error is 0 would be empty.
    std::erase_if(chart.rows, [](const ErrorRow& row) { return row.max == 0.0; });
    if (!always_zero.empty()) chart.always_zero = "Always 0: " + listed(always_zero) + ".";
    // The last bin of a histogram may end far beyond the largest error, where no axis goes.
    for (ErrorRow& row : chart.rows)
      for (ErrorBin& bin : row.bins) bin.below = std::min(bin.below, end);
  }
  return charts;
}

}  // namespace contactcheck::report
