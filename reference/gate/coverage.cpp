#include "reference/gate/coverage.h"

#include <algorithm>
#include <set>

#include "reference/gate/blame.h"
#include "reference/scene/file_text.h"

namespace contactcheck {
namespace {
Check failure(const std::string& rule, const std::string& reason) {
  Check out;
  out.rule = rule;
  out.verdict = Verdict::kFail;
  out.red = true;
  out.reason = reason;
  return out;
}

std::string quoted(const std::vector<std::string>& patterns) {
  std::string out;
  for (const std::string& pattern : patterns) out += (out.empty() ? "" : ", ") + in_quotes(pattern);
  return out;
}

Check idle_rule(const Rule& rule) {
  Check out =
      failure(rule.name, "matches nothing: no row has a scene of " + quoted(rule.scenes.wanted));
  if (!rule.detectors.wanted.empty())
    out.reason += " and a detector of " + quoted(rule.detectors.wanted);
  out.why = rule.why;
  return out;
}

void add_idle(const Rule& rule, const Patterns& patterns, const char* what,
              std::string RowName::*name, const std::vector<RowName>& rows,
              std::vector<Check>& out) {
  for (const std::string& pattern : patterns.wanted) {
    const bool used = std::any_of(rows.begin(), rows.end(),
                                  [&](const RowName& row) { return matches(pattern, row.*name); });
    if (used) continue;
    out.push_back(failure(rule.name, "matches nothing: no row of the rule has a " +
                                         std::string(what) + " " + in_quotes(pattern)));
    out.back().why = rule.why;
  }
}

Check lost(const results::Run& old, const std::string& reason) {
  Check out = failure(kBaselineRule, reason);
  out.scene = old.scene;
  out.detector = old.detector;
  return out;
}

// Status and message of a row that ended well before.
Check ended(const results::Index& now, const results::Run& row) {
  static const Rule accuracy = [] {
    Rule rule;
    rule.measure = find_measure("status");
    return rule;
  }();
  Check out = lost(row, row.message);
  out.measured = std::string("status ") + name_of(row.status);
  out.allowed = "ok, that of the baseline";
  out.frame = worst_frame(accuracy, now, row);
  out.rerun = rerun_command(accuracy, now, row, Verdict::kFail);
  return out;
}

}  // namespace

std::vector<Check> idle_patterns(const Rule& rule, const std::vector<RowName>& rows) {
  if (rows.empty()) return {idle_rule(rule)};
  std::vector<Check> out;
  add_idle(rule, rule.scenes, "scene", &RowName::scene, rows, out);
  add_idle(rule, rule.detectors, "detector", &RowName::detector, rows, out);
  return out;
}

std::optional<Check> too_many_open(const Policy& policy, const GateResult& result) {
  const std::vector<std::string> open = result.rules_with(Verdict::kCannotJudge);
  if (!policy.cannot_judge_at_most || open.size() <= *policy.cannot_judge_at_most)
    return std::nullopt;
  Check out = failure(kOpenRule, "they are " + quoted(open));
  out.measured = "rules that cannot judge " + std::to_string(open.size());
  out.allowed = "at most " + std::to_string(*policy.cannot_judge_at_most);
  return out;
}

std::vector<Check> lost_rows(const results::Index& now, const results::Results& before) {
  std::vector<Check> out;
  std::set<std::string> lost_scenes;
  for (const results::Run& old : before.runs) {
    const results::Run* const row = now.run(old.scene, old.detector);
    if (row != nullptr) {
      if (old.ok() && !row->ok()) out.push_back(ended(now, *row));
    } else if (now.scene(old.scene) != nullptr || !now.runs_of(old.scene).empty()) {
      out.push_back(lost(old, "the baseline has this detector in this scene, the results do not"));
    } else if (lost_scenes.insert(old.scene).second) {
      out.push_back(failure(kBaselineRule, "the baseline has this scene, the results do not"));
      out.back().scene = old.scene;
    }
  }
  return out;
}

}  // namespace contactcheck
