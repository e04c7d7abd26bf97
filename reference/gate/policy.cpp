#include "reference/gate/policy.h"

#include <fnmatch.h>

#include <algorithm>
#include <limits>

#include "core/types/semantics.h"
#include "reference/text/file_text.h"
#include "reference/text/json_field.h"
#include "reference/text/lists.h"

namespace contactcheck::gate {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

constexpr Measure kMeasures[] = {
    {"recall", MeasureKind::kLevel, "", 0, 1},
    {"missed", MeasureKind::kLevel, "", 0, kEndless},
    {"spurious", MeasureKind::kLevel, "", 0, kEndless},
    {"spurious_rate", MeasureKind::kLevel, "", 0, 1},
    {"near", MeasureKind::kLevel, "", 0, kEndless},
    {"near_max", MeasureKind::kLevel, "m", 0, kEndless},
    {"near_of_start_max", MeasureKind::kLevel, "", 0, 1},
    {"undecided", MeasureKind::kLevel, "", 0, kEndless},
    {"missed_length", MeasureKind::kGeometry, "m", 0, kEndless},
    {"covered_length_fraction", MeasureKind::kGeometry, "", 0, 1},
    {"spurious_distance_max", MeasureKind::kGeometry, "m", 0, kEndless},
    {"depth_error_max", MeasureKind::kGeometry, "m", 0, kEndless},
    {"depth_error_p95", MeasureKind::kGeometry, "m", 0, kEndless},
    {"depth_error_mean", MeasureKind::kGeometry, "m", 0, kEndless},
    {"normal_error_deg_max", MeasureKind::kGeometry, "degrees", 0, 180},
    {"normal_error_deg_p95", MeasureKind::kGeometry, "degrees", 0, 180},
    {"normal_error_deg_mean", MeasureKind::kGeometry, "degrees", 0, 180},
    {"hover_gap_max", MeasureKind::kGeometry, "m", 0, kEndless},
    {"late_frames", MeasureKind::kGeometry, "", -kEndless, kEndless},
    {"tunnelled", MeasureKind::kImpacts, "", 0, kEndless},
    {"new_missed", MeasureKind::kImpacts, "", 0, kEndless},
    {"early_max", MeasureKind::kImpacts, "steps", 0, 1},
    {"late_max", MeasureKind::kImpacts, "steps", 0, 1},
    {"stage_missed", MeasureKind::kStages, "", 0, kEndless},
    {"memory_bytes", MeasureKind::kMemory, "bytes", 0, kEndless},
    {"known_defects", MeasureKind::kDefects, "", 0, kEndless},
    {"oracle_wrong", MeasureKind::kOracle, "", 0, kEndless},
    {"contact_hash", MeasureKind::kHash, "", 0, 0},
    {"status", MeasureKind::kStatus, "", 0, 0},
    {"levels", MeasureKind::kLevels, "", 0, 0},
    {"questions", MeasureKind::kQuestions, "", 0, 0},
    {"speedup", MeasureKind::kSpeedup, "x", 0, kEndless},
    {"slowdown", MeasureKind::kSlowdown, "x", 0, kEndless}};

}  // namespace

const Measure* find_measure(const std::string& name) {
  for (const Measure& m : kMeasures)
    if (name == m.name) return &m;
  return nullptr;
}

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const Measure& m : kMeasures) names.emplace_back(m.name);
  return names;
}

bool is_timing(const Measure& measure) {
  return measure.kind == MeasureKind::kSpeedup || measure.kind == MeasureKind::kSlowdown;
}

bool is_accuracy_number(const Measure& measure) {
  switch (measure.kind) {
    case MeasureKind::kHash:
    case MeasureKind::kStatus:
    case MeasureKind::kLevels:
    case MeasureKind::kQuestions:
      return false;
    default:
      return !is_timing(measure);
  }
}

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

bool Patterns::hold(const std::string& name) const {
  const auto fits = [&](const std::string& pattern) { return matches(pattern, name); };
  return std::any_of(wanted.begin(), wanted.end(), fits) &&
         std::none_of(unwanted.begin(), unwanted.end(), fits);
}

namespace {

using Keys = std::vector<std::string>;

Keys bounds_of(const Measure& measure) {
  switch (measure.kind) {
    case MeasureKind::kHash:
      return {"unchanged", "equals"};
    case MeasureKind::kStatus:
      return {"equals"};
    case MeasureKind::kLevels:
    case MeasureKind::kQuestions:
      return {"includes"};
    case MeasureKind::kSpeedup:
      return {"at_least", "at_most"};  // or both
    case MeasureKind::kSlowdown:
    case MeasureKind::kOracle:
      return {"at_most"};
    default:
      return {"at_most", "at_least", "unchanged"};
  }
}

// Beside those of every rule and the bounds.
Keys own_keys(const Measure& measure) {
  if (is_timing(measure))
    return {"question", "reference", "part", "floor_us", "noise_width", "noisy"};
  if (measure.kind == MeasureKind::kLevel) return {"level", "rounded"};
  if (measure.kind == MeasureKind::kStages) return {"stage"};
  return {};
}

Keys allowed_keys(const Measure& measure) {
  Keys keys = {"rule", "why", "measure", "scenes", "error", "refused", "unjudged"};
  // The oracle is none of the detectors.
  if (measure.kind != MeasureKind::kOracle) keys.emplace_back("detectors");
  for (const Keys& more : {bounds_of(measure), own_keys(measure)})
    keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

Patterns parse_patterns(const text::JsonField& field) {
  Patterns out;
  for (const text::JsonField& item : field.items(1)) {
    const std::string pattern = item.text();
    if (pattern == "!") item.refuse("a pattern, also behind \"!\"");
    if (pattern[0] == '!')
      out.unwanted.push_back(pattern.substr(1));
    else
      out.wanted.push_back(pattern);
  }
  if (out.wanted.empty()) field.fail("has no pattern without \"!\"; it holds nothing");
  return out;
}

bool fails(const text::JsonField& rule, const std::string& key, bool otherwise) {
  return rule.has(key) ? rule.at(key).one_of({"pass", "fail"}) == "fail" : otherwise;
}

double parse_limit(const text::JsonField& field, const Measure& measure) {
  text::NumberRange range;
  range.low = measure.least;
  range.high = measure.greatest;
  range.low_open = is_timing(measure);  // no ratio of times is 0
  return field.number(range);
}

// A key that says something by being there.
bool says_true(const text::JsonField& rule, const std::string& key) {
  if (!rule.has(key)) return false;
  const text::JsonField field = rule.at(key);
  if (!field.is(text::JsonValue::Kind::kBool) || !field.value().boolean) field.refuse("true");
  return true;
}

std::vector<std::string> question_names() {
  std::vector<std::string> names;
  for (const Question question : kQuestions) names.emplace_back(name_of(question));
  return names;
}

void parse_bound(const text::JsonField& field, Rule& rule) {
  if (rule.measure->kind == MeasureKind::kSpeedup && field.has("at_least") &&
      field.has("at_most")) {
    rule.bound = Bound::kBetween;
    rule.limit = parse_limit(field.at("at_least"), *rule.measure);
    rule.upper = parse_limit(field.at("at_most"), *rule.measure);
    if (rule.upper <= rule.limit)
      field.at("at_most").refuse("above at_least, which is " + text::shown(rule.limit));
    return;
  }
  const std::string key = field.exactly_one_of(bounds_of(*rule.measure));
  const text::JsonField bound = field.at(key);
  if (key == "unchanged") {
    says_true(field, key);
    rule.bound = Bound::kUnchanged;
  } else if (key == "includes") {
    rule.bound = Bound::kIncludes;
    const std::vector<std::string> known =
        rule.measure->kind == MeasureKind::kLevels ? level_names() : question_names();
    for (const text::JsonField& item : bound.items(1)) rule.included.push_back(item.one_of(known));
  } else if (key == "equals") {
    bound.one_of({rule.measure->kind == MeasureKind::kHash ? "truth" : "ok"});
    rule.bound = Bound::kEquals;
  } else {
    rule.bound = key == "at_most" ? Bound::kAtMost : Bound::kAtLeast;
    rule.limit = parse_limit(bound, *rule.measure);
  }
}

void parse_timing(const text::JsonField& field, Rule& rule) {
  constexpr text::NumberRange kShare{0.0, false, 10.0, false},
      kMicroseconds{0.0, false, 1e9, false};
  rule.question = field.at("question").one_of(question_names());
  rule.reference = field.at("reference").text();
  if (field.has("part"))
    rule.part = field.at("part").one_of({"playback", "cold", "contact_frames", "without_map"});
  if (field.has("floor_us")) rule.floor_us = field.at("floor_us").number(kMicroseconds);
  if (field.has("noise_width")) rule.noise_width = field.at("noise_width").number(kShare);
  rule.noisy_fails = fails(field, "noisy", false);
}

const Measure* parse_measure(const text::JsonField& field) {
  return find_measure(field.at("measure").one_of(measure_names()));
}

Rule parse_rule(const text::JsonField& field) {
  Rule rule;
  rule.measure = parse_measure(field);
  field.only_keys(allowed_keys(*rule.measure));
  rule.name = field.at("rule").text();
  if (field.has("why")) rule.why = field.at("why").text();
  rule.scenes = parse_patterns(field.at("scenes"));
  if (rule.measure->kind != MeasureKind::kOracle)
    rule.detectors = parse_patterns(field.at("detectors"));
  parse_bound(field, rule);
  if (field.has("level")) rule.level = field.at("level").one_of(level_names());
  rule.rounded = says_true(field, "rounded");
  if (field.has("stage")) rule.stage = field.at("stage").text();
  if (is_timing(*rule.measure)) parse_timing(field, rule);
  rule.unjudged_fails = fails(field, "unjudged", false);
  rule.error_fails = fails(field, "error", true);
  rule.refused_fails = fails(field, "refused", true);
  return rule;
}

void require_own_name(const text::JsonField& field, const Rule& rule,
                      const std::vector<Rule>& others) {
  for (std::size_t i = 0; i < others.size(); ++i)
    if (others[i].name == rule.name)
      field.at("rule").refuse("different from rules[" + std::to_string(i) + "].rule");
}

}  // namespace

bool needs_baseline(const Rule& rule) {
  return rule.bound == Bound::kUnchanged || rule.measure->kind == MeasureKind::kSlowdown;
}

std::string allowed_text(const Rule& rule) {
  if (rule.bound == Bound::kUnchanged) return "that of the baseline";
  if (rule.bound == Bound::kEquals)
    return rule.measure->kind == MeasureKind::kHash ? "that of the truth" : "ok";
  if (rule.bound == Bound::kIncludes) return text::joined(rule.included) + " among them";
  const std::string unit = rule.measure->unit;
  const auto number = [&](double limit) {
    return text::shown(limit) + (unit == "x" || unit.empty() ? "" : " ") + unit;
  };
  return (rule.bound == Bound::kAtMost ? "at most " : "at least ") + number(rule.limit) +
         (rule.bound == Bound::kBetween ? " and at most " + number(rule.upper) : "");
}

Policy read_policy(const std::filesystem::path& file) {
  const std::string document = "policy " + text::in_quotes(file.string());
  const text::JsonValue value = text::parse_json(text::read_file_bytes(file, "policy"), document);
  const text::JsonField root(value, document);
  root.only_keys({"schema", "id", "title", "rules", "cannot_judge_at_most"});
  root.at("schema").one_of({"contactcheck-policy/1"});
  Policy policy;
  policy.id = root.at("id").text();
  policy.title = root.at("title").text();
  if (root.has("cannot_judge_at_most"))
    policy.cannot_judge_at_most = root.at("cannot_judge_at_most").whole(0, 1'000'000);
  for (const text::JsonField& item : root.at("rules").items(1)) {
    Rule rule = parse_rule(item);
    require_own_name(item, rule, policy.rules);
    policy.rules.push_back(std::move(rule));
  }
  return policy;
}

}  // namespace contactcheck::gate
