#include "reference/report/separation_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "reference/report/format.h"
#include "reference/statistics/statistics.h"

namespace contactcheck {
namespace {
using results::Run;

// The frames of one separation among the values of all frames; none where there are none.
template <typename Value>
std::span<const Value> values_at(const std::vector<Value>& values, std::size_t separation,
                                 std::size_t orientations) {
  if (values.size() < (separation + 1) * orientations) return {};
  return std::span(values).subspan(separation * orientations, orientations);
}

std::string median_time(std::span<const std::optional<double>> values) {
  std::vector<double> times;
  for (const std::optional<double>& value : values)
    if (value) times.push_back(*value);
  return times.empty() ? "-" : format_number(median(std::move(times)));
}

std::string sum_text(std::span<const std::uint64_t> values) {
  if (values.empty()) return "-";
  return format_count(std::accumulate(values.begin(), values.end(), std::uint64_t{0}));
}

template <typename Cell>
TitledTable table(const std::string& title, const results::Sweep& sweep, const RunList& runs,
                  const Cell& cell) {
  TitledTable out{title, "", {{"detector", true, ""}}, {}};
  for (const double separation : sweep.separations)
    out.columns.push_back({fmt::format("{:g} %", 100.0 * separation), false, ""});
  for (const Run* run : runs) {
    if (!run->ok()) continue;
    std::vector<std::string>& cells = out.rows.emplace_back();
    cells.push_back(run->detector);
    for (std::size_t s = 0; s < sweep.separations.size(); ++s) cells.push_back(cell(*run, s));
  }
  return out;
}

bool timed(const RunList& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [](const Run* run) { return run->per_frame.frame_ms.has_value(); });
}

}  // namespace

std::vector<TitledTable> separation_tables(const results::Scene& scene, const RunList& runs) {
  if (!scene.sweep) return {};
  const results::Sweep& sweep = *scene.sweep;
  const std::size_t orientations = sweep.orientations;
  const auto time = [&](const Run& run, std::size_t s) {
    const auto& times = run.per_frame.frame_ms;
    return times ? median_time(values_at(*times, s, orientations)) : "-";
  };
  const auto errors = [&](const Run& run, std::size_t s) {
    return sum_text(values_at(run.per_frame.missed, s, orientations)) + " / " +
           sum_text(values_at(run.per_frame.spurious, s, orientations));
  };
  std::vector<TitledTable> out;
  if (std::none_of(runs.begin(), runs.end(), [](const Run* run) { return run->ok(); })) return out;
  if (timed(runs)) {
    TitledTable& times = out.emplace_back(
        table("Time of a frame against separation (ms, playback, medians over the orientations)",
              sweep, runs, time));
    times.columns.push_back({"passes", false, ""});
    std::size_t row = 0;
    for (const Run* run : runs)
      if (run->ok())
        times.rows[row++].push_back(run->times.empty() ? "-"
                                                       : format_count(run->times.front().passes));
  }
  out.push_back(table(
      "Missed / spurious against separation (at the finest level judged, sums over orientations)",
      sweep, runs, errors));
  out.front().text = fmt::format(
      "Distance sweep: {} orientations at each separation, given in % of the size ({} m); below 0 "
      "the second body is pushed so far beyond the first touch.",
      orientations, format_number(scene.size));
  return out;
}

}  // namespace contactcheck
