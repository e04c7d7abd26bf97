#include "reference/results/ab_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "reference/results/diff_text.h"
#include "reference/results/statistics.h"

namespace contactcheck::results {
namespace {

using Lines = std::vector<std::string>;

std::string time_line(const AbTime& t) {
  return fmt::format("{}  {}  {}, {:.3g} -> {:.3g} ms a frame", t.scene, t.detector,
                     ratio_text(t.ratio, kFewestForInterval), t.base_ms, t.head_ms);
}

Lines lines_of(const AbJudgement& judgement, AbVerdict verdict) {
  Lines lines;
  for (const AbTime& time : judgement.times)
    if (time.verdict == verdict) lines.push_back(time_line(time));
  return lines;
}

Lines faster_lines(const AbJudgement& judgement, const AbLimits& limits) {
  Lines lines;
  for (auto time = judgement.times.rbegin(); time != judgement.times.rend(); ++time)
    if (time->ratio.high * limits.slower_than < 1.0) lines.push_back(time_line(*time));
  return lines;
}

Lines change_lines(const std::vector<RowChange>& changes) {
  Lines lines;
  for (const RowChange& change : changes) lines.push_back(change_line(change));
  return lines;
}

struct Section {
  std::string title;
  Lines lines;
};

std::vector<Section> sections_of(const AbJudgement& judgement, const AbSetting& setting) {
  const char* const allowed = setting.accuracy_may_change ? " (allowed)" : "";
  return {{fmt::format("Slower than {:.2f}x", setting.limits.slower_than),
           lines_of(judgement, AbVerdict::kSlower)},
          {std::string("Other answers, base -> head") + allowed, change_lines(judgement.answers)},
          {std::string("Other answers from round to round of one build") + allowed,
           change_lines(judgement.unsteady)},
          {"Too noisy to judge: more rounds or a quieter machine would tell",
           lines_of(judgement, AbVerdict::kTooNoisy)},
          {"Faster", faster_lines(judgement, setting.limits)},
          {"Only in base", judgement.only_base},
          {"Only in head", judgement.only_head}};
}

std::string limits_text(const AbSetting& setting) {
  return fmt::format(
      "{} rounds in turns; time(head) / time(base), geometric mean and 95 % interval over rounds; "
      "allowed {:.2f}x, or {:g} us a frame",
      setting.rounds, setting.limits.slower_than, setting.limits.floor_us);
}

std::string verdict_text(const AbJudgement& judgement, const AbSetting& setting) {
  std::string text = fmt::format(
      "{}: {} of {} times are within the limit", setting.fails(judgement) ? "FAIL" : "PASS",
      lines_of(judgement, AbVerdict::kPass).size(), judgement.times.size());
  if (judgement.untimed > 0) text += fmt::format("; {} rows have no times", judgement.untimed);
  return text + ".";
}

std::string section_text(const Section& section) {
  if (section.lines.empty()) return "";
  std::string text = fmt::format("{} ({})\n", section.title, section.lines.size());
  for (std::size_t i = 0; i < std::min(section.lines.size(), kLinesPerSection); ++i)
    text += "  " + section.lines[i] + "\n";
  if (section.lines.size() > kLinesPerSection)
    text += fmt::format("  ... and {} more\n", section.lines.size() - kLinesPerSection);
  return text;
}

const char* name_of(AbVerdict verdict) {
  switch (verdict) {
    case AbVerdict::kSlower:
      return "**slower**";
    case AbVerdict::kTooNoisy:
      return "too noisy to judge";
    case AbVerdict::kPass:
      return "pass";
  }
  return "";
}

// Detectors' names and messages may hold what Markdown would read.
std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (std::string("\\`*_{}[]<>|#").find(c) != std::string::npos) out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

}  // namespace

std::string ab_text(const AbJudgement& judgement, const AbSetting& setting) {
  std::string text =
      fmt::format("base  {}\nhead  {}\n{}\n\n", setting.base, setting.head, limits_text(setting));
  for (const Section& section : sections_of(judgement, setting)) text += section_text(section);
  if (judgement.times.empty()) text += "Nothing was timed in every round of both.\n";
  return text + verdict_text(judgement, setting) + "\n";
}

std::string ab_markdown(const AbJudgement& judgement, const AbSetting& setting) {
  std::string text = fmt::format("## contactcheck ab\n\n{}\n\n{}.\n",
                                 verdict_text(judgement, setting), limits_text(setting));
  for (const Section& section : sections_of(judgement, setting)) {
    if (section.lines.empty()) continue;
    text += fmt::format("\n### {} ({})\n\n", escaped(section.title), section.lines.size());
    for (const std::string& line : section.lines) text += "- " + escaped(line) + "\n";
  }
  text +=
      "\n| scene | detector | head / base | 95 % | base ms | head ms | |\n"
      "|---|---|--:|--:|--:|--:|---|\n";
  for (const AbTime& t : judgement.times)
    text += fmt::format("| {} | {} | {:.2f} | {:.2f} to {:.2f} | {:.3g} | {:.3g} | {} |\n",
                        escaped(t.scene), escaped(t.detector), t.ratio.value, t.ratio.low,
                        t.ratio.high, t.base_ms, t.head_ms, name_of(t.verdict));
  return text;
}

std::vector<std::string> ab_failures(const AbJudgement& judgement, const AbSetting& setting) {
  Lines failures;
  if (judgement.times.empty())
    failures.push_back("nothing was timed in every round of both: there is nothing to compare");
  for (const std::string& line : lines_of(judgement, AbVerdict::kSlower))
    failures.push_back(fmt::format("slower than {:.2f}x: {}", setting.limits.slower_than, line));
  if (setting.accuracy_may_change) return failures;
  for (const std::string& line : change_lines(judgement.answers))
    failures.push_back("other answers than base: " + line);
  for (const std::string& line : change_lines(judgement.unsteady))
    failures.push_back("other answers from round to round: " + line);
  return failures;
}

}  // namespace contactcheck::results
