#include "reference/report/tables/level_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scene_choice.h"

namespace contactcheck::report {
namespace {

using results::LevelCounts, results::Run;

struct Cells {
  HeatCell recall, spurious;
};

Cells counts_cells(LevelCounts counts, const std::string& where) {
  counts.set_rates();
  const std::string label =
      fmt::format("{}: {} true, {} missed, {} reported, {} spurious", where,
                  grouped_digits(counts.truth), grouped_digits(counts.missed),
                  grouped_digits(counts.reported), grouped_digits(counts.spurious));
  std::optional<double> missed;
  if (counts.truth > 0)
    missed = static_cast<double>(counts.missed) / static_cast<double>(counts.truth);
  return {{format_rate(counts.recall), missed, label},
          {format_error_rate(counts.spurious_rate), counts.spurious_rate, label}};
}

Cells sum_cells(const std::string& detector, const std::vector<const Run*>& runs,
                std::optional<Level> level) {
  LevelCounts sum;
  std::optional<Level> finest;
  for (const Run* run : runs) {
    const std::optional<Level> own = level ? level : run->per_frame.level;
    const LevelCounts* counts = claimed_counts(*run, own);
    if (counts == nullptr) continue;
    if (finest && finest != own) {
      const HeatCell differ = {"levels differ", {}, "", "aside"};
      return {differ, differ};
    }
    finest = own;
    sum += *counts;
  }
  return finest ? counts_cells(sum, detector + ", all scenes") : Cells{};
}

Cells scene_cells(const Run* run, std::optional<Level> level) {
  if (run == nullptr) return {};
  const std::string where = run->detector + " in " + run->scene;
  if (!run->ok()) {
    const HeatCell error = {name_of(run->status), {}, where + ": " + run->message, "error"};
    return {error, error};
  }
  const std::optional<Level> own = level ? level : run->per_frame.level;
  const LevelCounts* counts = claimed_counts(*run, own);
  return counts == nullptr ? Cells{} : counts_cells(*counts, where + ", level " + name_of(*own));
}

}  // namespace

std::vector<Level> judged_levels(const results::Results& results) {
  std::vector<Level> out;
  for (const Level level : kLevels)
    if (std::any_of(results.runs.begin(), results.runs.end(),
                    [&](const Run& run) { return claimed_counts(run, level) != nullptr; }))
      out.push_back(level);
  return out;
}

LevelTables level_tables(const results::Index& index, std::optional<Level> level) {
  std::vector<std::string> scenes, shown, columns = {"detector"};
  for (const results::Scene& scene : index.results().scenes)
    if (!scene.family) scenes.push_back(scene.id);
  for (const results::Scene* scene : shown_scenes(index.results()))
    if (!scene->family) shown.push_back(scene->id);
  if (scenes.size() > 1) columns.push_back("all scenes");
  columns.insert(columns.end(), shown.begin(), shown.end());
  LevelTables out{{columns, {}}, {columns, {}}};
  for (const std::string& detector : index.detectors()) {
    std::vector<const Run*> present;
    for (const std::string& scene : scenes)
      if (const Run* run = index.run(scene, detector)) present.push_back(run);
    if (std::none_of(present.begin(), present.end(), [&](const Run* run) {
          return !run->ok() || claimed_counts(*run, level ? level : run->per_frame.level);
        }))
      continue;
    const HeatCell name = {detector, {}, ""};
    std::vector<HeatCell> recall = {name}, spurious = {name};
    const auto add = [&](Cells cells) {
      recall.push_back(std::move(cells.recall));
      spurious.push_back(std::move(cells.spurious));
    };
    if (scenes.size() > 1) add(sum_cells(detector, present, level));
    for (const std::string& scene : shown) add(scene_cells(index.run(scene, detector), level));
    out.recall.rows.push_back(std::move(recall));
    out.spurious.rows.push_back(std::move(spurious));
  }
  return out;
}

}  // namespace contactcheck::report
