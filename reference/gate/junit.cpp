#include "reference/gate/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace contactcheck::gate {
namespace {

// U+FFFE and U+FFFF, in UTF-8.
constexpr const char* kNoCharacters[] = {"\xef\xbf\xbe", "\xef\xbf\xbf"};

void replace_no_characters(std::string& text) {
  for (const char* const none : kNoCharacters)
    for (std::size_t at = 0; (at = text.find(none, at)) != std::string::npos;)
      text.replace(at, 3, "?");
}

std::string escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\n':
    case '\r':
    case '\t':
      return "&#" + std::to_string(static_cast<int>(c)) + ";";  // attributes would lose them
    default:
      return static_cast<unsigned char>(c) < 0x20 ? "?" : std::string(1, c);
  }
}

std::string name_of_case(const Check& check) {
  if (check.scene.empty()) return check.reason;
  return check.detector.empty() ? check.scene : check.scene + " " + check.detector;
}

std::string details(const Check& check) {
  std::string out = sentence_of(check);
  if (!check.rerun.empty()) out += "\n" + check.rerun;
  return check.why.empty() ? out : out + "\n" + check.why;
}

std::string test_case(const Check& check) {
  const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"",
                                       xml_escaped(check.rule), xml_escaped(name_of_case(check)));
  const std::string message = xml_escaped(sentence_of(check)), body = xml_escaped(details(check));
  if (check.red)
    return head +
           fmt::format(">\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n",
                       name_of(check.verdict), message, body) +
           "    </testcase>\n";
  if (check.verdict == Verdict::kPass) return head + "/>\n";
  return head + fmt::format(">\n      <skipped message=\"{}: {}\"/>\n    </testcase>\n",
                            name_of(check.verdict), message);
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

std::string test_suite(const RuleChecks& group) {
  Tally tally;
  std::string cases;
  for (const Check* check : group.checks) {
    tally.add(*check);
    cases += test_case(*check);
  }
  return fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n", xml_escaped(group.rule),
                     tally.text(), cases);
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += escaped(c);
  replace_no_characters(out);
  return out;
}

std::string junit_xml(const GateResult& result) {
  Tally tally;
  for (const Check& check : result.checks) tally.add(check);
  std::string suites;
  for (const RuleChecks& group : by_rule(result, [](const Check&) { return true; }))
    suites += test_suite(group);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" {}>\n{}</testsuites>\n",
      xml_escaped("contactcheck gate " + result.policy), tally.text(), suites);
}

}  // namespace contactcheck::gate
