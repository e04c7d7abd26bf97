#include "reference/report/separation_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"
#include "reference/statistics/statistics.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

// The frames of one separation among the values of all frames; none where there are none.
std::vector<Json> values_at(const Json& run, const char* key, std::size_t separation,
                            std::size_t orientations) {
  const Json& per_frame = run.at("per_frame");
  const auto values = per_frame.find(key);
  if (values == per_frame.end() || !values->is_array() ||
      values->size() < (separation + 1) * orientations)
    return {};
  const auto first = values->begin() + static_cast<std::ptrdiff_t>(separation * orientations);
  return {first, first + static_cast<std::ptrdiff_t>(orientations)};
}

std::string median_time(const std::vector<Json>& values) {
  std::vector<double> times;
  for (const Json& value : values)
    if (value.is_number()) times.push_back(value.get<double>());
  if (times.empty()) return "-";
  return format_number(median(std::move(times)));
}

std::string sum_text(const std::vector<Json>& values) {
  if (values.empty()) return "-";
  std::uint64_t sum = 0;
  for (const Json& value : values) sum += value.get<std::uint64_t>();
  return format_count(sum);
}

std::vector<std::string> titles_of(const Json& sweep) {
  std::vector<std::string> titles;
  for (const Json& separation : sweep.at("separations"))
    titles.push_back(fmt::format("{:g} %", 100.0 * separation.get<double>()));
  return titles;
}

// `titles` must outlive them.
std::vector<Column> columns_of(const std::vector<std::string>& titles) {
  std::vector<Column> columns = {{"detector", true, ""}};
  for (const std::string& title : titles) columns.push_back({title.c_str(), false, ""});
  return columns;
}

template <typename Cell>
std::string table(const std::string& paragraph, const Json& sweep, const RunList& runs,
                  const Cell& cell) {
  std::string rows;
  for (const Json& run : runs) {
    if (run.at("status") != "ok") continue;
    std::vector<std::string> cells = {run.at("detector").get<std::string>()};
    for (std::size_t s = 0; s < sweep.at("separations").size(); ++s) cells.push_back(cell(run, s));
    rows += table_line(cells);
  }
  const std::vector<std::string> titles = titles_of(sweep);
  return titled_table(paragraph, columns_of(titles), rows);
}

bool timed(const RunList& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const Json& run) {
    return run.at("status") == "ok" && run.at("per_frame").contains("frame_ms");
  });
}

}  // namespace

std::string separation_tables(const Json& scene, const RunList& runs) {
  if (!scene.contains("sweep")) return "";
  const Json& sweep = scene.at("sweep");
  const auto orientations = sweep.at("orientations").get<std::size_t>();
  const auto time = [&](const Json& run, std::size_t s) {
    return median_time(values_at(run, "frame_ms", s, orientations));
  };
  const auto errors = [&](const Json& run, std::size_t s) {
    return sum_text(values_at(run, "missed", s, orientations)) + " / " +
           sum_text(values_at(run, "spurious", s, orientations));
  };
  std::string out = fmt::format(
      "Distance sweep: {} orientations at each separation, given in % of the size ({} m); below 0 "
      "the second body is pushed so far beyond the first touch.\n\n",
      orientations, format_number(scene.at("size")));
  if (timed(runs))
    out += table(
        "Time of a frame against separation (ms, cold, medians over the orientations that "
        "were timed):",
        sweep, runs, time);
  return out + table(
                   "Missed / spurious against separation (at the finest level judged, sums over "
                   "orientations):",
                   sweep, runs, errors);
}

}  // namespace contactcheck
