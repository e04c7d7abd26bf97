#include "reference/gate/reading.h"

#include "reference/text/json_value.h"

namespace contactcheck::gate {
namespace {

Reading without(const std::string& why) {
  Reading out;
  out.why_not = why;
  return out;
}

Reading number(double value) {
  Reading out;
  out.value = value;
  return out;
}

Reading number_or(const std::optional<double>& value, const std::string& why_none) {
  return value ? number(*value) : without(why_none);
}

std::string why_no_level(Level level, const results::Run& row) {
  const std::string head = std::string("level ") + name_of(level) + " is not judged";
  const auto reason = row.not_judged.find(level);
  if (reason != row.not_judged.end()) return head + ": " + reason->second;
  return head + ": the detector does not claim it, or the scene does not ask for it";
}

Reading count_of(const std::string& measure, const results::LevelCounts& counts,
                 const std::string& level) {
  if (measure == "missed") return number(static_cast<double>(counts.missed));
  if (measure == "spurious") return number(static_cast<double>(counts.spurious));
  if (measure == "recall")
    return number_or(counts.recall, "there is no true contact at level " + level);
  return number_or(counts.spurious_rate, "nothing was reported at level " + level);
}

Reading read_level(const Rule& rule, const results::Run& row) {
  const std::optional<Level> level = level_of(rule, row);
  if (!level) return without("no level that the detector claims was judged");
  if (rule.rounded && row.levels_rounded.empty())
    return without("the detector is fed doubles: nothing is rounded");
  const results::Levels& levels = rule.rounded ? row.levels_rounded : row.levels;
  const auto counts = levels.find(*level);
  if (counts == levels.end()) return without(why_no_level(*level, row));
  const std::string name = name_of(*level);
  if (counts->second.informative)
    return without("level " + name + " is informative for this detector: shown, never gated");
  Reading out = count_of(rule.measure->name, counts->second, name);
  out.level = level;
  return out;
}

Reading read_geometry(const Rule& rule, const results::Run& row) {
  std::optional<double> value;
  for (const auto& [name, error] : results::errors_of(row.geometry))
    if (rule.measure->name == name) value = error;
  return number_or(value, std::string(rule.measure->name) + " was not measured in this row");
}

Reading read_stages(const Rule& rule, const results::Run& row) {
  double sum = 0.0;
  bool found = false;
  for (const results::Stage& stage : row.stages) {
    if (!rule.stage.empty() && stage.name != rule.stage) continue;
    found = true;
    sum += static_cast<double>(stage.missed);
  }
  if (!found)
    return without(rule.stage.empty() ? "the detector has no stages"
                                      : "the detector has no stage \"" + rule.stage + "\"");
  return number(sum);
}

Reading read_defects(const results::Results& results, const results::Run& row) {
  if (!results.known_defects)
    return without("the results hold no comparison with known defects: no hard cases ran");
  std::size_t count = 0;
  for (const auto* sightings :
       {&results.known_defects->unlisted, &results.known_defects->not_shown})
    for (const results::Sightings& s : *sightings)
      if (s.scene == row.scene && s.detector == row.detector) count += s.values.size();
  return number(static_cast<double>(count));
}

}  // namespace

std::optional<Level> level_of(const Rule& rule, const results::Run& row) {
  return rule.level.empty() ? row.per_frame.level : level_from_name(rule.level);
}

Reading read_measure(const Rule& rule, const results::Results& results, const results::Run& row) {
  switch (rule.measure->kind) {
    case MeasureKind::kLevel:
      return read_level(rule, row);
    case MeasureKind::kGeometry:
      return read_geometry(rule, row);
    case MeasureKind::kStages:
      return read_stages(rule, row);
    case MeasureKind::kDefects:
      return read_defects(results, row);
    default:
      return number(static_cast<double>(row.memory_bytes));
  }
}

Reading read_oracle_wrong(const results::Scene& scene) {
  return number(static_cast<double>(scene.pairs->oracle_wrong));
}

std::string measured_text(const Rule& rule, const Reading& reading) {
  const std::string unit = rule.measure->unit;
  std::string out = std::string(rule.measure->name) + " " + text::shown(*reading.value);
  if (!unit.empty()) out += " " + unit;
  if (reading.level) out += std::string(" at level ") + name_of(*reading.level);
  if (rule.rounded) out += " of the rounded input";
  if (!rule.stage.empty()) out += " in stage " + rule.stage;
  return out;
}

}  // namespace contactcheck::gate
