#include "reference/gate/gate.h"

#include <optional>
#include <vector>

#include "core/types/check.h"
#include "reference/gate/accuracy_rule.h"
#include "reference/gate/blame.h"
#include "reference/gate/coverage.h"
#include "reference/gate/timing_reading.h"

namespace contactcheck {
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

}  // namespace contactcheck
