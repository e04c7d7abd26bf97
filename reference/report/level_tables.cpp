#include "reference/report/level_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "reference/report/format.h"
#include "reference/report/run_row.h"

namespace contactcheck::report {
namespace {

using results::LevelCounts, results::Run;

void add_counts(LevelCounts counts, const std::string& where, std::vector<HeatCell>& recall,
                std::vector<HeatCell>& spurious) {
  counts.set_rates();
  const std::string label =
      fmt::format("{}: {} true, {} missed, {} reported, {} spurious", where,
                  grouped_digits(counts.truth), grouped_digits(counts.missed),
                  grouped_digits(counts.reported), grouped_digits(counts.spurious));
  const std::optional<double> missed =
      counts.truth == 0
          ? std::nullopt
          : std::optional(static_cast<double>(counts.missed) / static_cast<double>(counts.truth));
  recall.push_back({format_rate(counts.recall), missed, label});
  spurious.push_back({format_error_rate(counts.spurious_rate), counts.spurious_rate, label});
}

void add_to_both(const HeatCell& cell, std::vector<HeatCell>& recall,
                 std::vector<HeatCell>& spurious) {
  recall.push_back(cell);
  spurious.push_back(cell);
}

void add_sum(const std::string& detector, const std::vector<const Run*>& runs,
             std::optional<Level> level, std::vector<HeatCell>& recall,
             std::vector<HeatCell>& spurious) {
  LevelCounts sum;
  std::optional<Level> finest;
  for (const Run* run : runs) {
    const std::optional<Level> own = level ? level : run->per_frame.level;
    const LevelCounts* counts = claimed_counts(*run, own);
    if (counts == nullptr) continue;
    if (finest && finest != own)
      return add_to_both({"levels differ", {}, "", "aside"}, recall, spurious);
    finest = own;
    sum += *counts;
  }
  if (!finest) return add_to_both({}, recall, spurious);
  add_counts(sum, detector + ", all scenes", recall, spurious);
}

void add_scene(const Run* run, std::optional<Level> level, std::vector<HeatCell>& recall,
               std::vector<HeatCell>& spurious) {
  if (run == nullptr) return add_to_both({}, recall, spurious);
  const std::string where = run->detector + " in " + run->scene;
  if (!run->ok())
    return add_to_both({name_of(run->status), {}, where + ": " + run->message, "error"}, recall,
                       spurious);
  const std::optional<Level> own = level ? level : run->per_frame.level;
  const LevelCounts* counts = claimed_counts(*run, own);
  if (counts == nullptr) return add_to_both({}, recall, spurious);
  add_counts(*counts, where + ", level " + name_of(*own), recall, spurious);
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
  std::vector<std::string> scenes, columns = {"detector"};
  for (const results::Scene& scene : index.results().scenes)
    if (!scene.family) scenes.push_back(scene.id);
  if (scenes.size() > 1) columns.push_back("all scenes");
  columns.insert(columns.end(), scenes.begin(), scenes.end());
  LevelTables out{{columns, {}}, {columns, {}}};
  for (const std::string& detector : index.detectors()) {
    std::vector<const Run*> runs, present;
    for (const std::string& scene : scenes) runs.push_back(index.run(scene, detector));
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(present),
                 [](const Run* run) { return run != nullptr; });
    if (std::none_of(present.begin(), present.end(), [&](const Run* run) {
          return !run->ok() || claimed_counts(*run, level ? level : run->per_frame.level);
        }))
      continue;
    const HeatCell name = {detector, {}, ""};
    std::vector<HeatCell> recall = {name}, spurious = {name};
    if (scenes.size() > 1) add_sum(detector, present, level, recall, spurious);
    for (const Run* run : runs) add_scene(run, level, recall, spurious);
    out.recall.rows.push_back(std::move(recall));
    out.spurious.rows.push_back(std::move(spurious));
  }
  return out;
}

}  // namespace contactcheck::report
