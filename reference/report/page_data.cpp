#include "reference/report/page_data.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "reference/report/claims.h"
#include "reference/report/goals_table.h"
#include "reference/report/headline.h"
#include "reference/report/known_defects.h"
#include "reference/report/random_pairs.h"
#include "reference/report/run_row.h"
#include "reference/report/speed_error.h"
#include "reference/report/summary.h"
#include "reference/results/results_json.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
using results::LevelCounts, results::Results, results::Run;

constexpr const char* kFinest = "finest";

Json to_json(const TitledTable& table) {
  Json columns = Json::array();
  for (const Column& column : table.columns)
    columns.push_back({{"title", column.title}, {"left", column.left}});
  Json out = {{"title", table.title},
              {"text", table.text},
              {"columns", std::move(columns)},
              {"rows", table.rows}};
  if (!table.id.empty()) out["id"] = table.id;
  return out;
}

Json to_json(const std::vector<TitledTable>& tables) {
  Json out = Json::array();
  for (const TitledTable& table : tables) out.push_back(to_json(table));
  return out;
}

Json pairs_json(const Results& results) {
  Json out = Json::array();
  for (const results::Scene& scene : results.scenes)
    if (scene.pairs)
      out.push_back({{"scene", scene.id},
                     {"sentence", pairs_line(scene) + "."},
                     {"table", to_json(pairs_table(scene))}});
  return out;
}

// Coarse before fine.
std::vector<Level> judged_levels_of(const Results& results) {
  std::vector<Level> out;
  for (const Level level : kLevels)
    if (std::any_of(results.runs.begin(), results.runs.end(), [&](const Run& run) {
          const LevelCounts* counts = counts_of(run, level);
          return counts != nullptr && !counts->informative;
        }))
      out.push_back(level);
  return out;
}

// Of one detector's runs. Pairs of bodies and pairs of triangles do not add up: at the finest level
// there is a sum only where that is the same everywhere.
Json sum_of(const std::vector<const Run*>& runs, std::optional<Level> level) {
  std::optional<LevelCounts> sum;
  std::optional<Level> finest;
  for (const Run* run : runs) {
    const std::optional<Level> own = level ? level : run->per_frame.level;
    const LevelCounts* counts = counts_of(*run, own);
    if (counts == nullptr || counts->informative) continue;
    if (finest && finest != own) return "levels differ";
    finest = own;
    if (!sum) sum.emplace();
    *sum += *counts;
  }
  if (!sum) return nullptr;
  return {{"truth", sum->truth},
          {"reported", sum->reported},
          {"hit", sum->hit},
          {"missed", sum->missed},
          {"spurious", sum->spurious}};
}

// Per level, per detector.
Json sums_json(const Results& results, const std::vector<std::string>& detectors,
               const std::vector<Level>& levels) {
  std::set<std::string> families;
  for (const results::Scene& scene : results.scenes)
    if (scene.family) families.insert(scene.id);
  std::map<std::string, std::vector<const Run*>> runs;
  for (const Run& run : results.runs)
    if (!families.contains(run.scene)) runs[run.detector].push_back(&run);
  Json out = Json::object();
  for (const std::string& detector : detectors) {
    out[kFinest].push_back(sum_of(runs[detector], std::nullopt));
    for (const Level level : levels) out[name_of(level)].push_back(sum_of(runs[detector], level));
  }
  return out;
}

struct Measure {
  const char* name;
  ErrorMeasure measure;
};
constexpr Measure kMeasures[] = {{"worse", ErrorMeasure::kWorse},
                                 {"missed", ErrorMeasure::kMissed},
                                 {"spurious", ErrorMeasure::kSpurious}};

// Of one choice of scenes and one level; null where nothing can be drawn.
Json level_charts(const SpeedErrorCharts& charts, SpeedErrorChoice choice) {
  const std::vector<std::string>& detectors = charts.detectors();
  Json out = {{"counts", std::vector<Json>(detectors.size())}};
  bool any = false;
  for (const Measure& measure : kMeasures)
    for (const bool hot : {false, true}) {
      choice.measure = measure.measure;
      choice.hot = hot;
      const SpeedError chart = charts.chart(choice);
      Json points = Json::array();
      for (const SpeedErrorPoint& p : chart.points) {
        const auto at = static_cast<std::size_t>(
            std::find(detectors.begin(), detectors.end(), p.detector) - detectors.begin());
        points.push_back({at, p.ms, p.error, p.on_front});
        out["counts"][at] = {{"question", name_of(p.question)},
                             {"level", name_of(p.level)},
                             {"truth", p.truth},
                             {"reported", p.reported},
                             {"missed", p.missed},
                             {"spurious", p.spurious}};
      }
      any = any || !points.empty();
      out[std::string(measure.name) + (hot ? " hot" : " cold")] = {
          {"points", std::move(points)}, {"left_out", left_out_sentence(chart)}};
    }
  return any || !choice.level ? out : Json(nullptr);
}

Json speed_error_json(const SpeedErrorCharts& charts, const std::vector<Level>& levels) {
  Json words = Json::array(), all = Json::array();
  for (std::size_t i = 0; i < charts.scenes().size(); ++i) {
    words.push_back(charts.scenes()[i].words);
    Json of_scenes = {{kFinest, level_charts(charts, {.scenes = i})}};
    for (const Level level : levels)
      if (Json of_level = level_charts(charts, {.scenes = i, .level = level}); !of_level.is_null())
        of_scenes[name_of(level)] = std::move(of_level);
    all.push_back(std::move(of_scenes));
  }
  return {{"detectors", charts.detectors()},
          {"scenes", std::move(words)},
          {"first", charts.first()},
          {"charts", std::move(all)}};
}

Json report_json(const Results& results) {
  const Headline headline = headline_of(results);
  const SpeedErrorCharts charts(results);
  const std::vector<Level> levels = judged_levels_of(results);
  Json findings = Json::array(), names = Json::array();
  for (const HeadlineFinding& f : headline.findings)
    findings.push_back({{"topic", f.topic}, {"sentence", f.sentence}});
  for (const Level level : levels) names.push_back(name_of(level));
  Json out = {{"title", headline.title},
              {"findings", std::move(findings)},
              {"fastest", headline.fastest},
              {"summary", to_json({"", "", summary_columns(), summary_lines(results)})},
              {"claims", to_json(claims_of(results))},
              {"goals", to_json({"", "", goal_columns(), goal_lines(results)})},
              {"pairs", pairs_json(results)},
              {"levels", std::move(names)},
              {"sums", sums_json(results, charts.detectors(), levels)},
              {"speed_error", speed_error_json(charts, levels)}};
  if (results.known_defects)
    out["known_defects"] = {{"sentence", known_defects_sentence(*results.known_defects)},
                            {"tables", to_json(known_defects_tables(*results.known_defects))}};
  return out;
}

}  // namespace

nlohmann::ordered_json page_data(const Results& results,
                                 const nlohmann::ordered_json& reproduction) {
  Json data = results::to_json(results);
  data["report"] = report_json(results);
  if (!reproduction.is_null()) data["reproduction"] = reproduction;
  return data;
}

}  // namespace contactcheck
