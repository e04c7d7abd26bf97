#include "reference/report/pictures/loss_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "reference/report/pictures/bar_plot.h"
#include "reference/report/pictures/svg.h"
#include "reference/report/tables/error_counts.h"
#include "reference/report/tables/section.h"
#include "reference/report/tables/stage_losses.h"

namespace contactcheck::report {
namespace {
using results::Run;

/// Those that the pictures are of, and how to call them.
struct ChosenScenes {
  std::set<std::string> ids;
  std::string words;
};

ChosenScenes chosen_scenes(const results::Results& results) {
  std::set<std::string> scenes, families;
  for (const results::Scene& scene : results.scenes)
    (scene.family ? families : scenes).insert(scene.id);
  if (scenes.empty()) return {families, fmt::format("{} families of hard cases", families.size())};
  if (scenes.size() == 1) return {scenes, "scene " + *scenes.begin()};
  return {scenes, fmt::format("{} scenes", scenes.size())};
}

std::vector<const Run*> ok_runs(const results::Results& results, const ChosenScenes& scenes) {
  std::vector<const Run*> runs;
  for (const Run& run : results.runs)
    if (run.ok() && scenes.ids.contains(run.scene)) runs.push_back(&run);
  return runs;
}

// Counts of different levels do not add up: a detector has a sum per level.
struct LevelSum : ErrorCounts {
  std::string detector;
  Level level = {};
};

std::vector<LevelSum> sums_of(const std::vector<const Run*>& runs) {
  std::vector<LevelSum> sums;
  for (const Run* run : runs) {
    if (!run->per_frame.level) continue;
    const Level level = *run->per_frame.level;
    auto sum = std::find_if(sums.begin(), sums.end(), [&](const LevelSum& s) {
      return s.detector == run->detector && s.level == level;
    });
    if (sum == sums.end()) sum = sums.insert(sums.end(), LevelSum{{}, run->detector, level});
    sum->add(*run, level);
  }
  return sums;
}

std::string part_of(std::uint64_t part, std::uint64_t whole) {
  return fmt::format("{} of {}", part, whole);
}

}  // namespace

std::string errors_picture(const results::Results& results) {
  const ChosenScenes scenes = chosen_scenes(results);
  BarChart chart;
  chart.title = "Missed and spurious contacts: " + scenes.words;
  chart.series = {"share of the true contacts missed", "share of the reports spurious"};
  chart.axis = "share of errors, nearly a logarithm";
  chart.scale = BarChart::Scale::kErrors;
  for (const LevelSum& sum : sums_of(ok_runs(results, scenes))) {
    if (sum.missed + sum.spurious == 0) continue;
    const std::string name = fmt::format("{} ({})", sum.detector, name_of(sum.level));
    const std::string missed = "missed " + part_of(sum.missed, sum.truth),
                      spurious = "spurious " + part_of(sum.spurious, sum.reported);
    chart.rows.push_back({name,
                          {{{0, sum.missed_share().value_or(0.0), name + ": " + missed}},
                           {{1, sum.spurious_share().value_or(0.0), name + ": " + spurious}}},
                          missed + "; " + spurious});
  }
  chart.foot = {
      "In brackets: the finest level that the detector claims. Detectors that are not "
      "shown made no error, or their status is not ok."};
  return bar_plot(chart);
}

std::string stages_picture(const results::Results& results) {
  const ChosenScenes scenes = chosen_scenes(results);
  std::vector<const Run*> runs = ok_runs(results, scenes);
  std::erase_if(runs, [](const Run* run) { return true_triangle_pairs(*run).value_or(0) == 0; });
  std::vector<DetectorLosses> all = stage_losses(runs);
  std::erase_if(all, [](const DetectorLosses& own) { return own.losses().empty(); });
  // The stages in the order in which they are met; the last one is of all that there is no further
  // colour for.
  std::vector<std::string> series;
  for (const DetectorLosses& own : all)
    for (const StageLoss& loss : own.losses())
      if (std::find(series.begin(), series.end(), loss.stage) == series.end())
        series.push_back(loss.stage);
  if (series.size() > kSeriesColours) {
    series.resize(kSeriesColours);
    series.back() = "other stages";
  }
  BarChart chart;
  chart.title = "Where true pairs are lost, stage by stage: " + scenes.words;
  chart.series = series;
  chart.axis = "share of the true pairs of triangles that was lost";
  for (const DetectorLosses& own : all) {
    BarRow& row = chart.rows.emplace_back(BarRow{own.detector, {BarLane{}}, ""});
    for (const StageLoss& loss : own.losses()) {
      const auto at = std::find(series.begin(), series.end(), loss.stage);
      const std::size_t index = at == series.end() ? series.size() - 1 : at - series.begin();
      row.lanes[0].push_back({index, loss.share,
                              fmt::format("{}: {} true pairs lost in {}", own.detector,
                                          part_of(loss.missed, own.truth), loss.stage)});
      row.words += fmt::format("{}{} {}", row.words.empty() ? "" : ", ", loss.stage, loss.missed);
    }
    row.words += fmt::format(" of {}", own.truth);
  }
  chart.foot = {
      "Detectors that are not shown lost none, have no stages, or were not judged at cells or "
      "triangles."};
  return bar_plot(chart);
}

namespace {

Blocks losses_blocks(const results::Index& index) {
  Blocks out;
  if (!errors_picture(index.results()).empty())
    out.emplace_back(Picture{
        kErrorsFile, "Share of true contacts missed and of reports spurious, a row per detector"});
  if (!stages_picture(index.results()).empty())
    out.emplace_back(Picture{
        kStagesFile, "Share of true pairs of triangles lost, stage by stage, a row per detector"});
  return out;
}

}  // namespace

extern const Section kLosses = {.id = "losses",
                                .title = "Errors by detector and stage",
                                .short_title = "Errors",
                                .build = losses_blocks,
                                .drawn_on_page = true};

}  // namespace contactcheck::report
