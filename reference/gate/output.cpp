#include "reference/gate/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace contactcheck::gate {
namespace {

std::vector<RuleChecks> left_open(const GateResult& result, Verdict verdict) {
  return by_rule(result, [&](const Check& c) { return !c.red && c.verdict == verdict; });
}

// A failure that does not make the gate red is one of a rule on times, where these are advisory.
std::string open_name(Verdict verdict) {
  return name_of(verdict) + std::string(verdict == Verdict::kFail ? " (advisory)" : "");
}

// The first check of a rule, and how many others there are.
std::string first_sentence(const RuleChecks& group) {
  const std::size_t others = group.checks.size() - 1;
  return sentence_of(*group.checks.front()) +
         (others == 0 ? "" : fmt::format("; and {} more", others));
}

// --- screen

constexpr std::size_t kMostRules = 8, kMostOfARule = 2;
constexpr const char *kRed = "\x1b[31m", *kGreen = "\x1b[32m", *kBold = "\x1b[1m";

std::string paint(const std::string& text, const char* code, bool color) {
  return color ? code + text + "\x1b[0m" : text;
}

std::string more_text(std::size_t shown, std::size_t all, const char* what) {
  return all > shown ? fmt::format("  ... and {} more {}\n", all - shown, what) : "";
}

std::string broken_rules(const GateResult& result, bool color) {
  const auto broken = by_rule(result, [](const Check& c) { return c.red; });
  const std::size_t shown_rules = std::min(broken.size(), kMostRules);
  std::string out;
  for (std::size_t r = 0; r < shown_rules; ++r) {
    const std::vector<const Check*>& checks = broken[r].checks;
    const std::size_t shown = std::min(checks.size(), kMostOfARule);
    out += paint("FAIL", kRed, color) + "  " + paint(broken[r].rule, kBold, color) + "\n";
    if (!checks.front()->why.empty()) out += "  (" + checks.front()->why + ")\n";
    for (std::size_t i = 0; i < shown; ++i) {
      out += "  " + sentence_of(*checks[i]) + "\n";
      if (!checks[i]->rerun.empty()) out += "    " + checks[i]->rerun + "\n";
    }
    out += more_text(shown, checks.size(), "of this rule");
  }
  return out + more_text(shown_rules, broken.size(), "broken rules");
}

// One line a rule: what was left open, and the first place of it.
std::string open_rules(const GateResult& result, Verdict verdict, bool color) {
  const auto open = left_open(result, verdict);
  if (open.empty()) return "";
  const std::size_t shown = std::min(open.size(), kMostRules);
  std::string out = paint(open_name(verdict), kBold, color) + "\n";
  for (std::size_t i = 0; i < shown; ++i)
    out += fmt::format("  {}: {}\n", open[i].rule, first_sentence(open[i]));
  return out + more_text(shown, open.size(), "rules");
}

// --- JUnit

std::string test_case(const Check& check) {
  // Without what the results have instead, which is another every time.
  std::string name = check.reason.substr(0, check.reason.find("; the results have"));
  if (!check.scene.empty())
    name = check.detector.empty() ? check.scene : check.scene + " " + check.detector;
  const std::string sentence = sentence_of(check), message = xml_escaped(sentence);
  const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"",
                                       xml_escaped(check.rule), xml_escaped(name));
  if (check.red) {
    std::string details = sentence;
    if (!check.rerun.empty()) details += "\n" + check.rerun;
    if (!check.why.empty()) details += "\n" + check.why;
    return head +
           fmt::format(">\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n",
                       name_of(check.verdict), message, xml_escaped(details)) +
           "    </testcase>\n";
  }
  if (check.verdict == Verdict::kPass) return head + "/>\n";
  return head + fmt::format(">\n      <skipped message=\"{}: {}\"/>\n    </testcase>\n",
                            open_name(check.verdict), message);
}

struct Tally {
  std::size_t tests = 0, failures = 0, skipped = 0;

  void add(const Check& check) {
    ++tests;
    failures += check.red;
    skipped += !check.red && check.verdict != Verdict::kPass;
  }
  std::string text() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\"", tests, failures,
                       skipped);
  }
};

// --- GitHub

constexpr std::size_t kMostOfAKind = 10;  // GitHub drops what is beyond
constexpr std::size_t kMostRows = 200;    // a summary may have 1 MiB
constexpr std::size_t kMostOfOpenRule = 3;

// Escaped as GitHub's runner decodes it: data of a command, or a property, which ends at ':' or
// ','.
std::string command_text(const std::string& text, bool property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return out;
}

// The first ten, or nine and how many more there are.
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

std::string open_annotations(const GateResult& result, const char* kind, Verdict verdict) {
  std::vector<std::string> lines;
  for (const RuleChecks& group : left_open(result, verdict))
    lines.push_back(
        github_annotation(kind, group.rule, open_name(verdict) + ": " + first_sentence(group)));
  return limited(lines, kind);
}

// Text of a table's cell, without what Markdown or HTML would interpret.
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

// A code span needs no escapes, except for '|', which would end the cell.
std::string code_cell(const std::string& text) {
  if (text.empty()) return "";
  std::string out = "`";
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : std::string(1, c == '`' ? '\'' : c);
  return out + "`";
}

std::string red_table(const GateResult& result) {
  std::string rows;
  std::size_t red = 0;
  for (const Check& check : result.checks) {
    if (!check.red || ++red > kMostRows) continue;
    const std::string remark = check.verdict == Verdict::kFail
                                   ? check.reason
                                   : std::string(name_of(check.verdict)) + ": " + check.reason;
    rows += "|";
    for (const std::string& text : {check.rule, check.scene, check.detector, check.measured,
                                    check.allowed, check.frame, remark})
      rows += " " + cell(text) + " |";
    rows += " " + code_cell(check.rerun) + " |\n";
  }
  if (red == 0) return "";
  return "| rule | scene | detector | measured | allowed | frame | remark | again |\n"
         "|---|---|---|---|---|---|---|---|\n" +
         rows + (red > kMostRows ? fmt::format("\nand {} more\n", red - kMostRows) : "") + "\n";
}

std::string open_list(const GateResult& result, Verdict verdict) {
  std::string out;
  for (const RuleChecks& group : left_open(result, verdict)) {
    const std::size_t shown = std::min(group.checks.size(), kMostOfOpenRule);
    out += fmt::format("- {}, {}:\n", cell(group.rule), open_name(verdict));
    for (std::size_t i = 0; i < shown; ++i)
      out += "  - " + cell(sentence_of(*group.checks[i])) + "\n";
    if (group.checks.size() > shown)
      out += fmt::format("  - and {} more\n", group.checks.size() - shown);
  }
  return out;
}

}  // namespace

std::string gate_screen(const GateResult& result, bool color) {
  const bool red = result.red();
  return fmt::format("{}  {}\n{}\n", paint(result.policy, kBold, color), result.title,
                     counts_text(result)) +
         broken_rules(result, color) + open_rules(result, Verdict::kFail, color) +
         open_rules(result, Verdict::kTooNoisy, color) +
         open_rules(result, Verdict::kCannotJudge, color) +
         (red ? paint("gate: red", kRed, color) : paint("gate: green", kGreen, color)) + "\n";
}

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\n' || c == '\r' || c == '\t')
      out += "&#" + std::to_string(static_cast<int>(c)) + ";";  // attributes would lose them
    else
      out += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  // U+FFFE and U+FFFF, in UTF-8, are no characters.
  for (const char* const none : {"\xef\xbf\xbe", "\xef\xbf\xbf"})
    for (std::size_t at = 0; (at = out.find(none, at)) != std::string::npos;)
      out.replace(at, 3, "?");
  return out;
}

std::string junit_xml(const GateResult& result) {
  Tally all;
  std::string suites;
  for (const RuleChecks& group : by_rule(result, [](const Check&) { return true; })) {
    Tally tally;
    std::string cases;
    for (const Check* check : group.checks) {
      all.add(*check);
      tally.add(*check);
      cases += test_case(*check);
    }
    suites += fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n",
                          xml_escaped(group.rule), tally.text(), cases);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" {}>\n{}</testsuites>\n",
      xml_escaped("contactcheck gate " + result.policy), all.text(), suites);
}

std::string github_annotation(const std::string& kind, const std::string& title,
                              const std::string& message) {
  return fmt::format("::{} title={}::{}\n", kind, command_text(title, true),
                     command_text(message, false));
}

std::string github_annotations(const GateResult& result) {
  std::vector<std::string> errors;
  for (const Check& check : result.checks)
    if (check.red)
      errors.push_back(
          github_annotation("error", check.rule,
                            sentence_of(check) + (check.rerun.empty() ? "" : "\n" + check.rerun)));
  return limited(errors, "error") + open_annotations(result, "warning", Verdict::kFail) +
         open_annotations(result, "warning", Verdict::kTooNoisy) +
         open_annotations(result, "notice", Verdict::kCannotJudge);
}

std::string github_summary(const GateResult& result) {
  return fmt::format("## contactcheck gate {}: {}\n\n{}. {}.\n\n", cell(result.policy),
                     result.red() ? "red" : "green", cell(result.title), counts_text(result)) +
         red_table(result) + open_list(result, Verdict::kFail) +
         open_list(result, Verdict::kTooNoisy) + open_list(result, Verdict::kCannotJudge);
}

}  // namespace contactcheck::gate
