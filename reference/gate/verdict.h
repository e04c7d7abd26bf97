// The result of a gate: one check per rule, scene and detector.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace contactcheck::gate {

enum class Verdict {
  kPass,
  kFail,
  kTooNoisy,    ///< a ratio of times whose interval contains the limit and is wide
  kCannotJudge  ///< the results have no such number, none to compare, or too few passes
};

/// "pass", "fail", "too noisy to judge", "cannot judge"
const char* name_of(Verdict verdict);

struct Check {
  std::string rule, why;        ///< the second as the policy says it; may be empty
  std::string scene, detector;  ///< both may be empty, for a rule that matches nothing
  Verdict verdict = Verdict::kPass;
  bool red = false;      ///< the gate fails because of it
  std::string measured;  ///< "missed 3 at level triangle"; empty if nothing was measured
  std::string allowed;   ///< "at most 0"
  std::string reason;    ///< why it cannot be judged, or other remarks; may be empty
  std::string frame;     ///< the worst one: "frame 7"; may be empty
  std::string rerun;     ///< the command that shows it; may be empty
};

struct GateResult {
  std::string policy, title, results_command;
  std::size_t rules = 0;
  std::vector<Check> checks;  ///< by rule, then as in the results

  bool red() const;
  std::size_t count(Verdict verdict) const;
  /// The names of the rules with a check of that verdict, each once.
  std::vector<std::string> rules_with(Verdict verdict) const;
};

/// Checks of one rule, in the order of the first of each.
struct RuleChecks {
  std::string rule;
  std::vector<const Check*> checks;
};

/// Those checks for which `wanted` holds, by rule. Points into the result.
template <typename Wanted>
std::vector<RuleChecks> by_rule(const GateResult& result, Wanted wanted) {
  std::vector<RuleChecks> out;
  for (const Check& check : result.checks) {
    if (!wanted(check)) continue;
    if (out.empty() || out.back().rule != check.rule) out.push_back({check.rule, {}});
    out.back().checks.push_back(&check);
  }
  return out;
}

/// "142 checks of 9 rules: 138 pass, 1 fail, 0 too noisy to judge, 3 cannot judge (of 2 rules)"
std::string counts_text(const GateResult& result);

/// In one line: "bunny-touch  ffd-lazy: missed 3 at level triangle, allowed at most 0, frame 7".
std::string sentence_of(const Check& check);

}  // namespace contactcheck::gate
