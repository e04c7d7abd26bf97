#include "reference/gate/screen.h"

#include <fmt/format.h>

#include <algorithm>

namespace contactcheck::gate {
namespace {

constexpr std::size_t kMostRules = 8, kMostOfARule = 2;
constexpr const char *kRed = "\x1b[31m", *kGreen = "\x1b[32m", *kBold = "\x1b[1m";

std::string paint(const std::string& text, const char* code, bool color) {
  return color ? code + text + "\x1b[0m" : text;
}

std::string more_text(std::size_t shown, std::size_t all, const char* what) {
  return all > shown ? fmt::format("  ... and {} more {}\n", all - shown, what) : "";
}

std::string check_text(const Check& check) {
  return "  " + sentence_of(check) + "\n" +
         (check.rerun.empty() ? "" : "    " + check.rerun + "\n");
}

std::string broken_rule(const RuleChecks& group, bool color) {
  const std::size_t shown = std::min(group.checks.size(), kMostOfARule);
  std::string out = paint("FAIL", kRed, color) + "  " + paint(group.rule, kBold, color) + "\n";
  if (!group.checks.front()->why.empty()) out += "  (" + group.checks.front()->why + ")\n";
  for (std::size_t i = 0; i < shown; ++i) out += check_text(*group.checks[i]);
  return out + more_text(shown, group.checks.size(), "of this rule");
}

std::string broken_rules(const GateResult& result, bool color) {
  const auto broken = by_rule(result, [](const Check& c) { return c.red; });
  const std::size_t shown = std::min(broken.size(), kMostRules);
  std::string out;
  for (std::size_t i = 0; i < shown; ++i) out += broken_rule(broken[i], color);
  return out + more_text(shown, broken.size(), "broken rules");
}

// One line a rule: what was left open, and the first place of it.
std::string left_open(const GateResult& result, Verdict verdict, bool color) {
  const auto open = by_rule(result, [&](const Check& c) { return !c.red && c.verdict == verdict; });
  if (open.empty()) return "";
  const std::size_t shown = std::min(open.size(), kMostRules);
  std::string out = paint(name_of(verdict), kBold, color) + "\n";
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t others = open[i].checks.size() - 1;
    out += fmt::format("  {}: {}{}\n", open[i].rule, sentence_of(*open[i].checks.front()),
                       others == 0 ? "" : fmt::format("; and {} more", others));
  }
  return out + more_text(shown, open.size(), "rules");
}

}  // namespace

std::string gate_screen(const GateResult& result, bool color) {
  const bool red = result.red();
  return fmt::format("{}  {}\n{}\n", paint(result.policy, kBold, color), result.title,
                     counts_text(result)) +
         broken_rules(result, color) + left_open(result, Verdict::kTooNoisy, color) +
         left_open(result, Verdict::kCannotJudge, color) +
         (red ? paint("gate: red", kRed, color) : paint("gate: green", kGreen, color)) + "\n";
}

}  // namespace contactcheck::gate
