#include "reference/gate/gate.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "reference/gate/accuracy_rule.h"
#include "reference/gate/blame.h"
#include "reference/gate/coverage.h"
#include "reference/gate/row_index.h"
#include "reference/gate/timing_reading.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;
using Rows = std::vector<const Json*>;

class Gate {
 public:
  Gate(const RowIndex& now, const RowIndex* before) : now_(now), before_(before) {}

  void apply(const Rule& rule, std::vector<Check>& out) const {
    if (rule.measure->kind == MeasureKind::kOracle) return apply_to_oracle(rule, out);
    const Rows rows = rows_of(rule);
    for (const Json* row : rows) out.push_back(check_of(rule, *row));
    for (Check& idle : idle_patterns(rule, rows)) out.push_back(std::move(idle));
  }

 private:
  Rows rows_of(const Rule& rule) const {
    Rows rows;
    for (const Json& row : now_.results().at("runs"))
      if (rule.scenes.hold(text_at(row, "scene")) && rule.detectors.hold(text_at(row, "detector")))
        rows.push_back(&row);
    return rows;
  }

  // A row without an answer; a rule about the status itself judges it like any other.
  std::optional<Check> without_answer(const Rule& rule, const Json& row) const {
    const std::string status = text_at(row, "status");
    if (status == "ok" || rule.measure->kind == MeasureKind::kStatus) return std::nullopt;
    Check out = cannot_judge(rule, status + ": " + text_at(row, "message"));
    if (status != "error") return out;
    out.verdict = rule.error_fails ? Verdict::kFail : Verdict::kCannotJudge;
    out.measured = "status error";
    out.reason = text_at(row, "message");
    return out;
  }

  Check judged(const Rule& rule, const Json& row) const {
    if (const auto none = without_answer(rule, row)) return *none;
    return is_timing(*rule.measure) ? judge_timing(rule, now_, before_, row)
                                    : judge_accuracy(rule, now_, before_, row);
  }

  Check check_of(const Rule& rule, const Json& row) const {
    Check out = judged(rule, row);
    out.scene = text_at(row, "scene");
    out.detector = text_at(row, "detector");
    if (out.verdict != Verdict::kPass) {
      if (out.verdict == Verdict::kFail) out.frame = worst_frame(rule, now_, row);
      out.rerun = rerun_command(rule, now_, row);
    }
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

  void apply_to_oracle(const Rule& rule, std::vector<Check>& out) const {
    Rows scenes;
    Json named = Json::array();  // the scenes, as rows of which idle patterns know the scene
    for (const Json& scene : now_.results().value("scenes", Json::array()))
      if (scene.contains("pairs") && rule.scenes.hold(text_at(scene, "id"))) {
        Check check = with_colour(rule, judge_oracle(rule, scene));
        check.scene = text_at(scene, "id");
        check.detector = "oracle";
        if (check.verdict != Verdict::kPass) check.rerun = pairs_command(scene);
        out.push_back(std::move(check));
        named.push_back({{"scene", scene.at("id")}});
      }
    for (const Json& scene : named) scenes.push_back(&scene);
    for (Check& idle : idle_patterns(rule, scenes)) out.push_back(std::move(idle));
  }

  const RowIndex& now_;
  const RowIndex* before_;
};

}  // namespace

GateResult run_gate(const Policy& policy, const Json& results, const Json* baseline) {
  const RowIndex now(results);
  const std::optional<RowIndex> before =
      baseline == nullptr ? std::nullopt : std::optional<RowIndex>(*baseline);
  const Gate gate(now, before ? &*before : nullptr);
  GateResult out;
  out.policy = policy.id;
  out.title = policy.title;
  out.results_command = text_at(results, "command");
  out.rules = policy.rules.size();
  for (const Rule& rule : policy.rules) gate.apply(rule, out.checks);
  if (before)
    for (Check& lost : lost_rows(now, *before)) out.checks.push_back(std::move(lost));
  return out;
}

}  // namespace contactcheck
