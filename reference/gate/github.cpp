#include "reference/gate/github.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace contactcheck::gate {
namespace {

constexpr std::size_t kMostOfAKind = 10;  // GitHub drops what is beyond
constexpr std::size_t kMostRows = 200;    // a summary may have 1 MiB
constexpr std::size_t kMostOfOpenRule = 3;

// As GitHub's runner takes it apart: data of a command, and a property, which ends at ':' or ','.
std::string command_text(const std::string& text, bool property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return out;
}

std::string red_annotation(const Check& check) {
  const std::string rerun = check.rerun.empty() ? "" : "\n" + check.rerun;
  return github_annotation("error", check.rule, sentence_of(check) + rerun);
}

std::string open_annotation(const char* kind, Verdict verdict, const RuleChecks& group) {
  const std::size_t others = group.checks.size() - 1;
  return github_annotation(kind, group.rule,
                           std::string(name_of(verdict)) + ": " +
                               sentence_of(*group.checks.front()) +
                               (others == 0 ? "" : fmt::format("; and {} more", others)));
}

// The first ten, or nine and how many there are besides.
std::string limited(const std::vector<std::string>& lines, const char* kind) {
  const bool all = lines.size() <= kMostOfAKind;
  const std::size_t shown = all ? lines.size() : kMostOfAKind - 1;
  std::string out;
  for (std::size_t i = 0; i < shown; ++i) out += lines[i];
  if (!all)
    out += github_annotation(
        kind, "contactcheck gate",
        fmt::format("and {} more; the job summary lists them", lines.size() - shown));
  return out;
}

std::vector<std::string> open_annotations(const GateResult& result, const char* kind,
                                          Verdict verdict) {
  std::vector<std::string> lines;
  for (const RuleChecks& group :
       by_rule(result, [&](const Check& c) { return !c.red && c.verdict == verdict; }))
    lines.push_back(open_annotation(kind, verdict, group));
  return lines;
}

// In a cell of a table: nothing that Markdown or HTML would take for its own.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      if (std::string("|*_`[]\\").find(c) != std::string::npos) out += '\\';
      out += c == '\n' || c == '\r' ? ' ' : c;
    }
  }
  return out;
}

// A code span does without escapes, but not without '|' being told from the table's own.
std::string code_cell(const std::string& text) {
  if (text.empty()) return "";
  std::string out = "`";
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : std::string(1, c == '`' ? '\'' : c);
  return out + "`";
}

std::string summary_row(const Check& check) {
  const std::string remark = check.verdict == Verdict::kFail
                                 ? check.reason
                                 : std::string(name_of(check.verdict)) + ": " + check.reason;
  std::string line = "|";
  for (const std::string& text : {check.rule, check.scene, check.detector, check.measured,
                                  check.allowed, check.frame, remark})
    line += " " + cell(text) + " |";
  return line + " " + code_cell(check.rerun) + " |\n";
}

std::string red_table(const GateResult& result) {
  std::string rows;
  std::size_t red = 0;
  for (const Check& check : result.checks)
    if (check.red && ++red <= kMostRows) rows += summary_row(check);
  if (red == 0) return "";
  return "| rule | scene | detector | measured | allowed | frame | remark | again |\n"
         "|---|---|---|---|---|---|---|---|\n" +
         rows + (red > kMostRows ? fmt::format("\nand {} more\n", red - kMostRows) : "") + "\n";
}

std::string open_list(const GateResult& result, Verdict verdict) {
  std::string out;
  for (const RuleChecks& group :
       by_rule(result, [&](const Check& c) { return !c.red && c.verdict == verdict; })) {
    const std::size_t shown = std::min(group.checks.size(), kMostOfOpenRule);
    out += fmt::format("- {}, {}:\n", cell(group.rule), name_of(verdict));
    for (std::size_t i = 0; i < shown; ++i)
      out += "  - " + cell(sentence_of(*group.checks[i])) + "\n";
    if (group.checks.size() > shown)
      out += fmt::format("  - and {} more\n", group.checks.size() - shown);
  }
  return out;
}

}  // namespace

std::string github_annotation(const std::string& kind, const std::string& title,
                              const std::string& message) {
  return fmt::format("::{} title={}::{}\n", kind, command_text(title, true),
                     command_text(message, false));
}

std::string github_annotations(const GateResult& result) {
  std::vector<std::string> errors;
  for (const Check& check : result.checks)
    if (check.red) errors.push_back(red_annotation(check));
  return limited(errors, "error") +
         limited(open_annotations(result, "warning", Verdict::kTooNoisy), "warning") +
         limited(open_annotations(result, "notice", Verdict::kCannotJudge), "notice");
}

std::string github_summary(const GateResult& result) {
  return fmt::format("## contactcheck gate {}: {}\n\n{}. {}.\n\n", cell(result.policy),
                     result.red() ? "red" : "green", cell(result.title), counts_text(result)) +
         red_table(result) + open_list(result, Verdict::kTooNoisy) +
         open_list(result, Verdict::kCannotJudge);
}

}  // namespace contactcheck::gate
