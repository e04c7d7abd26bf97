#include "reference/gate/reading.h"

#include <nlohmann/json.hpp>

#include "reference/scene/json_value.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

Reading without(const std::string& why) {
  Reading out;
  out.why_not = why;
  return out;
}

Reading number_or(const Json& value, const std::string& why_null) {
  if (value.is_null()) return without(why_null);
  Reading out;
  out.value = value.get<double>();
  return out;
}

std::string why_no_level(const std::string& level, const Json& row) {
  const Json reasons = row.value("not_judged", Json::object());
  const std::string head = "level " + level + " is not judged";
  if (reasons.contains(level)) return head + ": " + reasons.at(level).get<std::string>();
  return head + ": the detector does not claim it, or the scene does not ask for it";
}

Reading read_level(const Rule& rule, const Json& row) {
  const std::string level = level_of(rule, row);
  if (level.empty()) return without("no level that the detector claims was judged");
  if (rule.rounded && !row.contains("levels_rounded"))
    return without("the detector is fed doubles: nothing is rounded");
  const Json& levels = row.at(rule.rounded ? "levels_rounded" : "levels");
  if (!levels.contains(level)) return without(why_no_level(level, row));
  if (levels.at(level).value("informative", false))
    return without("level " + level + " is informative for this detector: shown, never gated");
  const std::string nothing = rule.measure->name == std::string("recall")
                                  ? "there is no true contact at level " + level
                                  : "nothing was reported at level " + level;
  Reading out = number_or(levels.at(level).at(rule.measure->field), nothing);
  out.level = level;
  return out;
}

Reading read_geometry(const Rule& rule, const Json& row) {
  const Json value = row.at("geometry").value(rule.measure->field, Json());
  return number_or(value, std::string(rule.measure->name) + " was not measured in this row");
}

Reading read_stages(const Rule& rule, const Json& row) {
  double sum = 0.0;
  bool found = false;
  for (const Json& stage : row.at("stages")) {
    if (!rule.stage.empty() && stage.at("name") != rule.stage) continue;
    found = true;
    sum += stage.at("missed").get<double>();
  }
  if (!found)
    return without(rule.stage.empty() ? "the detector has no stages"
                                      : "the detector has no stage \"" + rule.stage + "\"");
  return number_or(sum, "");
}

// Values of this row in a list of sightings.
double sightings_of_row(const Json& sightings, const Json& row) {
  std::size_t count = 0;
  for (const Json& s : sightings)
    if (s.at("scene") == row.at("scene") && s.at("detector") == row.at("detector"))
      count += s.at("values").size();
  return static_cast<double>(count);
}

Reading read_defects(const Json& results, const Json& row) {
  if (!results.contains("known_defects"))
    return without("the results hold no comparison with known defects: no hard cases ran");
  const Json& defects = results.at("known_defects");
  return number_or(sightings_of_row(defects.at("unlisted"), row) +
                       sightings_of_row(defects.at("not_shown"), row),
                   "");
}

}  // namespace

std::string level_of(const Rule& rule, const Json& row) {
  if (!rule.level.empty()) return rule.level;
  return row.at("per_frame").value("level", "");
}

Reading read_measure(const Rule& rule, const RowIndex& results, const Json& row) {
  switch (rule.measure->kind) {
    case MeasureKind::kLevel:
      return read_level(rule, row);
    case MeasureKind::kGeometry:
      return read_geometry(rule, row);
    case MeasureKind::kStages:
      return read_stages(rule, row);
    case MeasureKind::kDefects:
      return read_defects(results.results(), row);
    default:
      return number_or(row.at(rule.measure->field), "");
  }
}

Reading read_oracle_wrong(const Json& scene) {
  return number_or(scene.at("pairs").at("rational").at("oracle_wrong"), "");
}

std::string measured_text(const Rule& rule, const Reading& reading) {
  const std::string unit = rule.measure->unit;
  std::string out = std::string(rule.measure->name) + " " + shown(*reading.value);
  if (!unit.empty()) out += " " + unit;
  if (!reading.level.empty()) out += " at level " + reading.level;
  if (rule.rounded) out += " of the rounded input";
  if (!rule.stage.empty()) out += " in stage " + rule.stage;
  return out;
}

}  // namespace contactcheck
