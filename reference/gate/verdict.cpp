#include "reference/gate/verdict.h"

#include <algorithm>

#include "reference/text/counted.h"

namespace contactcheck::gate {
namespace {

void append(std::string& text, const std::string& separator, const std::string& part) {
  if (!part.empty()) text += (text.empty() ? "" : separator) + part;
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kFail:
      return "fail";
    case Verdict::kTooNoisy:
      return "too noisy to judge";
    case Verdict::kCannotJudge:
      return "cannot judge";
  }
  return "";
}

bool GateResult::red() const {
  return std::any_of(checks.begin(), checks.end(), [](const Check& c) { return c.red; });
}

std::size_t GateResult::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::count_if(
      checks.begin(), checks.end(), [&](const Check& c) { return c.verdict == verdict; }));
}

std::vector<std::string> GateResult::rules_with(Verdict verdict) const {
  std::vector<std::string> out;
  for (const Check& check : checks)
    if (check.verdict == verdict && std::find(out.begin(), out.end(), check.rule) == out.end())
      out.push_back(check.rule);
  return out;
}

std::string counts_text(const GateResult& result) {
  using text::counted;
  std::string out =
      counted(result.checks.size(), "check") + " of " + counted(result.rules, "rule") + ":";
  for (const Verdict v :
       {Verdict::kPass, Verdict::kFail, Verdict::kTooNoisy, Verdict::kCannotJudge})
    out += std::string(v == Verdict::kPass ? " " : ", ") + std::to_string(result.count(v)) + " " +
           name_of(v);
  if (const std::size_t open = result.rules_with(Verdict::kCannotJudge).size(); open > 0)
    out += " (of " + counted(open, "rule") + ")";
  return out;
}

std::string sentence_of(const Check& check) {
  std::string where, what;
  const bool open = check.verdict != Verdict::kPass && check.verdict != Verdict::kFail;
  if (check.red && open) what = name_of(check.verdict);
  append(where, "  ", check.scene);
  append(where, "  ", check.detector);
  append(what, ": ", check.measured);
  if (!check.measured.empty()) append(what, ", ", "allowed " + check.allowed);
  append(what, ", ", check.frame);
  append(what, check.measured.empty() ? ": " : "; ", check.reason);
  append(where, ": ", what);
  return where;
}

}  // namespace contactcheck::gate
