#include "reference/gate/gate.h"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "core/types/check.h"
#include "reference/gate/accuracy_rule.h"
#include "reference/gate/blame.h"
#include "reference/gate/timing_reading.h"
#include "reference/text/file_text.h"

namespace contactcheck::gate {
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
  for (const std::string& pattern : patterns)
    out += (out.empty() ? "" : ", ") + text::in_quotes(pattern);
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
                                         std::string(what) + " " + text::in_quotes(pattern)));
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

namespace {

class Gate {
 public:
  Gate(const results::Index& now, const results::Index* before) : now_(now), before_(before) {}

  void apply(const Rule& rule, std::vector<Check>& out) const {
    std::vector<RowName> rows;
    if (rule.measure->kind == MeasureKind::kOracle) {
      for (const results::Scene& scene : now_.results().scenes) {
        if (!scene.pairs || !rule.scenes.hold(scene.id)) continue;
        rows.push_back({scene.id, ""});
        out.push_back(check_of_oracle(rule, scene));
      }
    } else {
      for (const results::Run& row : now_.results().runs) {
        if (!rule.scenes.hold(row.scene) || !rule.detectors.hold(row.detector)) continue;
        rows.push_back({row.scene, row.detector});
        out.push_back(check_of(rule, row));
      }
    }
    for (Check& idle : idle_patterns(rule, rows)) out.push_back(std::move(idle));
  }

 private:
  // A row without an answer; a rule about the status itself judges it like any other.
  std::optional<Check> without_answer(const Rule& rule, const results::Run& row) const {
    if (row.ok() || rule.measure->kind == MeasureKind::kStatus) return std::nullopt;
    Check out = cannot_judge(rule, name_of(row.status) + (": " + row.message));
    if (row.status != results::Status::kError) return out;
    out.verdict = rule.error_fails ? Verdict::kFail : Verdict::kCannotJudge;
    out.measured = "status error";
    out.reason = row.message;
    return out;
  }

  Check judged(const Rule& rule, const results::Run& row) const {
    if (const auto none = without_answer(rule, row)) return *none;
    return is_timing(*rule.measure) ? judge_timing(rule, now_, before_, row)
                                    : judge_accuracy(rule, now_, before_, row);
  }

  Check check_of(const Rule& rule, const results::Run& row) const {
    Check out = judged(rule, row);
    out.scene = row.scene;
    out.detector = row.detector;
    if (out.verdict != Verdict::kPass) {
      if (out.verdict == Verdict::kFail) out.frame = worst_frame(rule, now_, row);
      out.rerun = rerun_command(rule, now_, row, out.verdict);
    }
    return with_colour(rule, out);
  }

  static Check check_of_oracle(const Rule& rule, const results::Scene& scene) {
    Check out = judge_oracle(rule, scene);
    out.scene = scene.id;
    out.detector = "oracle";
    if (out.verdict != Verdict::kPass) out.rerun = pairs_command(scene);
    return with_colour(rule, out);
  }

  static Check with_colour(const Rule& rule, Check out) {
    out.rule = rule.name;
    out.why = rule.why;
    out.red = out.verdict == Verdict::kFail ||
              (out.verdict == Verdict::kTooNoisy && rule.noisy_fails) ||
              (out.verdict == Verdict::kCannotJudge && rule.unjudged_fails);
    return out;
  }

  const results::Index& now_;
  const results::Index* before_;
};

}  // namespace

GateResult run_gate(const Policy& policy, const results::Results& results,
                    const results::Results* baseline) {
  for (const Rule& rule : policy.rules)
    if (baseline == nullptr && needs_baseline(rule))
      throw InputError("policy \"" + policy.id + "\": rule \"" + rule.name +
                       "\" compares with an earlier run, and none is given; --baseline FILE names "
                       "one");
  const results::Index now(results);
  std::optional<results::Index> before;
  if (baseline != nullptr) before.emplace(*baseline);
  const Gate gate(now, before ? &*before : nullptr);
  GateResult out;
  out.policy = policy.id;
  out.title = policy.title;
  out.results_command = results.command;
  out.rules = policy.rules.size();
  for (const Rule& rule : policy.rules) gate.apply(rule, out.checks);
  if (baseline != nullptr)
    for (Check& lost : lost_rows(now, *baseline)) out.checks.push_back(std::move(lost));
  if (std::optional<Check> open = too_many_open(policy, out)) out.checks.push_back(*open);
  return out;
}

}  // namespace contactcheck::gate
