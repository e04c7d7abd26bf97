#include "reference/gate/accuracy_rule.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reference/text/json_value.h"
#include "reference/text/lists.h"

namespace contactcheck::gate {
namespace {

// The number that a rule is about, out of a row of results.
struct Reading {
  std::optional<double> value;
  std::optional<Level> level;  ///< of a measure that has levels
  std::string why_not;         ///< a sentence where there is no value
  bool fails = false;          ///< that there is none breaks the rule
};

Reading without(const std::string& why) { return {std::nullopt, std::nullopt, why}; }

Reading number(double value) { return {value, std::nullopt, "", false}; }

Reading number_or(const std::optional<double>& value, const std::string& why_none) {
  return value ? number(*value) : without(why_none);
}

Reading read_level(const Rule& rule, const results::Run& row) {
  const std::optional<Level> level = level_of(rule, row);
  if (!level) return without("no level that the detector claims was judged");
  if (rule.rounded && row.levels_rounded.empty())
    return without("the detector is given doubles: nothing is rounded");
  const std::string measure = rule.measure->name, name = name_of(*level);
  const results::Levels& levels = rule.rounded ? row.levels_rounded : row.levels;
  const auto found = levels.find(*level);
  if (found == levels.end()) {
    const auto reason = row.not_judged.find(*level);
    return without("level " + name + " is " +
                   (reason != row.not_judged.end()
                        ? reason->second
                        : "not judged: the detector does not claim it, or the scene does not ask "
                          "for it"));
  }
  const results::LevelCounts& counts = found->second;
  const results::NearReports within = counts.within.value_or(results::NearReports{});
  if (counts.informative)
    return without("level " + name + " is informative for this detector: shown, never gated");
  Reading out;
  if (measure == "missed")
    out = number(static_cast<double>(counts.missed));
  else if (measure == "spurious")
    out = number(static_cast<double>(counts.spurious));
  else if (measure == "near")
    out = number(static_cast<double>(within.near));
  else if (measure == "near_max")
    out = number(within.near_max);
  else if (measure == "near_of_start_max")
    out = number(within.near_of_start_max);
  else if (measure == "undecided")
    out = number(static_cast<double>(within.undecided));
  else if (measure == "recall")
    out = number_or(counts.recall, "there is no true contact at level " + name);
  else
    out = number_or(counts.spurious_rate, "nothing was reported at level " + name);
  out.level = level;
  return out;
}

Reading read_geometry(const Rule& rule, const results::Run& row) {
  std::optional<double> value;
  for (const auto& [name, error] : results::errors_of(row))
    if (rule.measure->name == name) value = error;
  return number_or(value, std::string(rule.measure->name) + " was not measured in this row");
}

// A detector that finds contact within steps and tells no time would pass every limit on times.
Reading read_impacts(const Rule& rule, const results::Run& row) {
  Reading out = read_geometry(rule, row);
  const auto found = row.levels.find(Level::kImpact);
  const std::string name = rule.measure->name;
  if (!out.value && found != row.levels.end() && found->second.hit > 0 &&
      (name == "early_max" || name == "late_max")) {
    out.fails = true;
    out.why_not = "it finds bodies that meet within steps and says of none when";
  }
  return out;
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
  for (const auto* sightings : {&results.known_defects->unlisted, &results.known_defects->not_shown,
                                &results.known_defects->changed})
    for (const results::Sightings& s : *sightings)
      if (s.scene == row.scene && s.detector == row.detector) count += s.values.size();
  return number(static_cast<double>(count));
}

// @pre the rule's measure is an accuracy number; the row's status is `ok`
Reading read_measure(const Rule& rule, const results::Results& results, const results::Run& row) {
  switch (rule.measure->kind) {
    case MeasureKind::kLevel:
      return read_level(rule, row);
    case MeasureKind::kGeometry:
      return read_geometry(rule, row);
    case MeasureKind::kImpacts:
      return read_impacts(rule, row);
    case MeasureKind::kStages:
      return read_stages(rule, row);
    case MeasureKind::kDefects:
      return read_defects(results, row);
    case MeasureKind::kMemory:
      return number(static_cast<double>(row.memory_bytes));
    case MeasureKind::kOracle:
    case MeasureKind::kHash:
    case MeasureKind::kStatus:
    case MeasureKind::kLevels:
    case MeasureKind::kQuestions:
    case MeasureKind::kSpeedup:
    case MeasureKind::kSlowdown:
      break;  // read elsewhere
  }
  throw std::logic_error("a rule on accuracy reads an accuracy number");
}

// "missed 3 at level triangle", "hover_gap_max 0.002 m"
std::string measured_text(const Rule& rule, const Reading& reading) {
  const std::string unit = rule.measure->unit;
  std::string out = std::string(rule.measure->name) + " " + text::shown(*reading.value);
  if (!unit.empty()) out += " " + unit;
  if (reading.level) out += std::string(" at level ") + name_of(*reading.level);
  if (rule.rounded) out += " of the rounded input";
  if (!rule.stage.empty()) out += " in stage " + rule.stage;
  return out;
}

Check checked(const Rule& rule, bool holds, const std::string& measured) {
  Check out;
  out.verdict = holds ? Verdict::kPass : Verdict::kFail;
  out.measured = measured;
  out.allowed = allowed_text(rule);
  return out;
}

// Whose change it is: the scene's, the machine's mathematical library's, or the detector's.
std::string why_hash_changed(const results::Run& row, const results::Run& old,
                             const results::Scene* scene, const results::Scene* old_scene) {
  if (row.frames != old.frames)
    return "the run has " + std::to_string(row.frames) + " frames, the baseline " +
           std::to_string(old.frames);
  if (scene == nullptr || old_scene == nullptr) return "";
  if (scene->truth_hash != old_scene->truth_hash)
    return "the truth changed as well: another scene, another motion or another oracle";
  return "the truth is as it was: the detector's answer changed";
}

Check hash_against_baseline(const Rule& rule, const results::Index& now,
                            const results::Index& before, const results::Run& row) {
  std::string reason;
  const results::Run* const old = row_before(before, row, reason);
  if (old == nullptr) return cannot_judge(rule, reason);
  Check out =
      checked(rule, row.contact_hash == old->contact_hash, "contact_hash " + row.contact_hash);
  out.allowed = old->contact_hash + ", that of the baseline";
  if (row.contact_hash != old->contact_hash)
    out.reason = why_hash_changed(row, *old, now.scene(row.scene), before.scene(row.scene));
  return out;
}

Check hash_against_truth(const Rule& rule, const results::Index& now, const results::Run& row) {
  const results::Scene* const scene = now.scene(row.scene);
  if (scene == nullptr) return cannot_judge(rule, "the results do not describe the scene");
  Check out =
      checked(rule, row.contact_hash == scene->truth_hash, "contact_hash " + row.contact_hash);
  out.allowed = scene->truth_hash + ", that of the truth";
  return out;
}

// A weaker claim is a weaker test: who claims less is wrong less often.
Check judge_claims(const Rule& rule, const results::Run& row) {
  const auto holds = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> claimed;
  std::vector<Level> unjudged;
  if (rule.measure->kind == MeasureKind::kLevels) {
    for (const Level level : row.semantics.levels) {
      claimed.emplace_back(name_of(level));
      if (holds(rule.included, claimed.back()) && !row.levels.contains(level))
        unjudged.push_back(level);
    }
  } else {
    for (const Question question : row.semantics.questions) claimed.emplace_back(name_of(question));
  }
  const bool all = std::all_of(rule.included.begin(), rule.included.end(),
                               [&](const std::string& name) { return holds(claimed, name); });
  if (!all || unjudged.empty())
    return checked(rule, all, std::string(rule.measure->name) + " " + text::joined(claimed));
  const auto reason = row.not_judged.find(unjudged.front());
  return cannot_judge(
      rule, std::string("level ") + name_of(unjudged.front()) + " is " +
                (reason != row.not_judged.end() ? reason->second
                                                : "not judged: the scene does not ask for it"));
}

bool within(const Rule& rule, double value) {
  return rule.bound == Bound::kAtMost ? value <= rule.limit : value >= rule.limit;
}

Check number_against_baseline(const Rule& rule, const results::Index& before,
                              const results::Run& row, const Reading& reading) {
  std::string reason;
  const results::Run* const old = row_before(before, row, reason);
  if (old == nullptr) return cannot_judge(rule, reason);
  Rule same_level = rule;
  same_level.level = reading.level ? name_of(*reading.level) : "";
  const Reading known = read_measure(same_level, before.results(), *old);
  if (!reading.value && !known.value) return cannot_judge(rule, reading.why_not);
  // What is there on one side alone has changed.
  Check out = checked(rule, reading.value == known.value, "");
  if (reading.value) out.measured = measured_text(rule, reading);
  out.allowed = (known.value ? text::shown(*known.value) : "none") + ", that of the baseline";
  if (!reading.value) out.reason = "was " + out.allowed + "; now " + reading.why_not;
  return out;
}

}  // namespace

std::optional<Level> level_of(const Rule& rule, const results::Run& row) {
  return rule.level.empty() ? row.per_frame.level : level_from_name(rule.level);
}

Check cannot_judge(const Rule& rule, const std::string& reason) {
  Check out;
  out.verdict = Verdict::kCannotJudge;
  out.allowed = allowed_text(rule);
  out.reason = reason;
  return out;
}

const results::Run* row_before(const results::Index& before, const results::Run& row,
                               std::string& reason) {
  const results::Run* const old = before.run(row.scene, row.detector);
  if (old == nullptr) {
    reason = "the baseline has no such row";
  } else if (!old->ok()) {
    reason = std::string("in the baseline its status is ") + name_of(old->status);
  }
  return reason.empty() ? old : nullptr;
}

Check judge_accuracy(const Rule& rule, const results::Index& now, const results::Index* before,
                     const results::Run& row) {
  if (rule.measure->kind == MeasureKind::kStatus) {
    Check out = checked(rule, row.ok(), std::string("status ") + name_of(row.status));
    out.reason = row.message;
    return out;
  }
  if (rule.measure->kind == MeasureKind::kHash)
    return rule.bound == Bound::kEquals ? hash_against_truth(rule, now, row)
                                        : hash_against_baseline(rule, now, *before, row);
  if (rule.bound == Bound::kIncludes) return judge_claims(rule, row);
  const Reading reading = read_measure(rule, now.results(), row);
  if (rule.bound == Bound::kUnchanged) return number_against_baseline(rule, *before, row, reading);
  if (!reading.value) {
    Check out = cannot_judge(rule, reading.why_not);
    if (reading.fails) out.verdict = Verdict::kFail;
    return out;
  }
  return checked(rule, within(rule, *reading.value), measured_text(rule, reading));
}

Check judge_oracle(const Rule& rule, const results::Scene& scene) {
  const Reading reading = number(static_cast<double>(scene.pairs->oracle_wrong));
  return checked(rule, within(rule, *reading.value), measured_text(rule, reading));
}

}  // namespace contactcheck::gate
