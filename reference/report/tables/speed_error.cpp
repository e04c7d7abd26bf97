#include "reference/report/tables/speed_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/types/semantics.h"
#include "reference/report/tables/format.h"
#include "reference/report/tables/section.h"

namespace contactcheck::report {
namespace {
using results::Run;
using Runs = std::vector<const Run*>;

// Counts of different levels do not add up: where the finest one is not the same in all scenes that
// were judged, it is the finest that the detector claims in each of them.
std::optional<Level> common_level(const Runs& runs) {
  Runs judged;
  std::set<Level> finest;
  for (const Run* run : runs) {
    if (!claimed_counts(*run, run->per_frame.level)) continue;
    judged.push_back(run);
    finest.insert(*run->per_frame.level);
  }
  if (finest.size() == 1) return *finest.begin();
  for (const Level level : kFineToCoarse)
    if (std::all_of(judged.begin(), judged.end(),
                    [&](const Run* run) { return claimed_counts(*run, level) != nullptr; }))
      return level;
  return {};
}

/// A point, or why there is none.
struct Attempt {
  std::optional<SpeedErrorPoint> point;
  std::string why;
};

std::optional<double> share_of(const ErrorCounts& counts, ErrorMeasure measure) {
  switch (measure) {
    case ErrorMeasure::kWorse:
      return counts.worse_share();
    case ErrorMeasure::kMissed:
      return counts.missed_share();
    case ErrorMeasure::kSpurious:
      return counts.spurious_share();
  }
  return {};
}

Attempt point_of(const std::string& detector, const Runs& runs, std::size_t scenes,
                 const SpeedErrorChoice& choice) {
  if (runs.size() < scenes)
    return {{}, fmt::format("ended well in {} of {} scenes", runs.size(), scenes)};
  const auto ms = mean_frame_ms(runs, choice.cold);
  if (!ms) return {{}, choice.cold ? "not timed cold" : "not timed"};
  SpeedErrorPoint point;
  const std::optional<Level> level = choice.level ? choice.level : common_level(runs);
  bool judged = false;
  for (const Run* run : runs) {
    judged = point.add(*run, level) || judged;
    point.timed.add(*run, run->times.front());
  }
  if (choice.level && !judged)
    return {{}, fmt::format("does not claim level {}", name_of(*choice.level))};
  const auto error = share_of(point, choice.measure);
  if (!judged || !error) return {{}, "nothing to judge"};
  point.detector = detector;
  point.question = runs.front()->times.front().question;
  point.level = *level;
  point.ms = *ms;
  point.error = *error;
  return {std::move(point), ""};
}

}  // namespace

void mark_front(std::vector<SpeedErrorPoint>& points) {
  std::vector<SpeedErrorPoint*> order;
  for (SpeedErrorPoint& point : points) order.push_back(&point);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return std::pair(a->ms, a->error) < std::pair(b->ms, b->error);
  });
  std::map<Question, double> least;  // error so far, by question
  for (SpeedErrorPoint* point : order) {
    const auto [it, first] = least.try_emplace(point->question, point->error);
    point->on_front = first || point->error < it->second;
    it->second = std::min(it->second, point->error);
  }
}

SpeedErrorCharts::SpeedErrorCharts(const results::Index& index)
    : index_(index), scenes_(scene_choices(index.results())) {}

std::size_t SpeedErrorCharts::first() const {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < scenes_.size(); ++i)
    points.push_back(chart({.scenes = i}).points.size());
  const std::size_t best = points.empty() ? 0 : *std::max_element(points.begin(), points.end());
  const auto first = std::find_if(points.begin(), points.end(),
                                  [&](std::size_t count) { return 2 * count >= best; });
  return static_cast<std::size_t>(first - points.begin());
}

SpeedError SpeedErrorCharts::chart(const SpeedErrorChoice& choice) const {
  const SceneChoice& scenes = scenes_.at(choice.scenes);
  SpeedError out{scenes.words, {}, {}};
  for (const std::string& detector : index_.detectors()) {
    Attempt attempt =
        point_of(detector, ok_runs(index_, detector, scenes), scenes.ids.size(), choice);
    if (attempt.point) {
      out.points.push_back(std::move(*attempt.point));
    } else {
      out.left_out.push_back({detector, attempt.why});
    }
  }
  mark_front(out.points);
  return out;
}

SpeedError speed_error(const results::Index& index) {
  const SpeedErrorCharts charts(index);
  return charts.scenes().empty() ? SpeedError{} : charts.chart({.scenes = charts.first()});
}

std::string left_out_sentence(const SpeedError& chart) {
  std::map<std::string, std::string> by_reason;
  for (const LeftOut& out : chart.left_out) {
    std::string& names = by_reason[out.why];
    names += (names.empty() ? "" : ", ") + out.detector;
  }
  std::string text;
  for (const auto& [why, names] : by_reason)
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", names, why);
  return text.empty() ? "" : "Not in the chart: " + text + ".";
}

const std::vector<Column>& speed_error_columns() {
  static const std::vector<Column> columns = {
      {"detector", true, "", "detector"},  {"question timed", true, "", "question"},
      {"ms/frame", false, "", "time"},     {"passes", false, "", "passes"},
      {"level", true, "", "level"},        {"truth", false, "", "truth"},
      {"missed", false, "", "missed"},     {"reported", false, "", "reported"},
      {"spurious", false, "", "spurious"}, {"error", false, "", "error"},
      {"on the front", true, "", "front"}};
  return columns;
}

std::string speed_error_time(const SpeedErrorPoint& point) {
  return format_number(point.ms) + point.timed.cut_text();
}

std::vector<std::string> speed_error_cells(const SpeedErrorPoint& p) {
  return {p.detector,
          name_of(p.question),
          speed_error_time(p),
          format_counts(p.timed.passes),
          name_of(p.level),
          format_count(p.truth),
          format_count(p.missed),
          format_count(p.reported),
          format_count(p.spurious),
          format_error_rate(p.error),
          p.on_front ? "yes" : ""};
}

namespace {

Blocks speed_error_blocks(const results::Index& index) {
  const SpeedError chart = speed_error(index);
  if (chart.points.empty()) return {};
  TitledTable table{"", "", speed_error_columns(), {}};
  for (const SpeedErrorPoint& point : chart.points) table.rows.push_back(speed_error_cells(point));
  Blocks out = {
      Picture{kSpeedErrorFile, "Every detector as a point: time per frame against share of errors"},
      Paragraph{fmt::format(
          "Over {}. A time is that of mapping, update and query in playback, the mean over all "
          "frames but the first. An error is the share of contacts missed or of reports spurious, "
          "whichever is worse, at the finest level judged in every scene. On the front: no other "
          "that answers the same question is faster without being worse.",
          chart.scenes)},
      std::move(table)};
  const std::string left_out = left_out_sentence(chart);
  if (!left_out.empty()) out.emplace_back(Paragraph{left_out});
  return out;
}

}  // namespace

extern const Section kSpeedAgainstError = {.id = "speed-error",
                                           .title = "Speed against error",
                                           .short_title = "Speed against error",
                                           .build = speed_error_blocks,
                                           .drawn_on_page = true};

}  // namespace contactcheck::report
