#include "reference/results/ab.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "reference/results/results_diff.h"
#include "reference/results/statistics.h"

namespace contactcheck::results {
namespace {

constexpr double kMicrosecondsPerMillisecond = 1e3;

/// A round with its rows by name.
struct Round {
  results::Index base, head;
};

AbVerdict verdict_of(const AbTime& time, const AbLimits& limits) {
  const Ratio& r = time.ratio;
  const double excess_us = (time.head_ms - time.base_ms) * kMicrosecondsPerMillisecond;
  if (r.low > limits.slower_than)
    return excess_us > limits.floor_us ? AbVerdict::kSlower : AbVerdict::kPass;
  const double most_us = (r.high - 1.0) * time.base_ms * kMicrosecondsPerMillisecond;
  const bool undecided = r.high > limits.slower_than && most_us > limits.floor_us;
  return undecided && r.high > kNoisyWidth * r.low ? AbVerdict::kTooNoisy : AbVerdict::kPass;
}

// The times of one row in every round of one side; empty where some round has none.
std::vector<double> times_of(const std::vector<Round>& rounds, results::Index Round::*side,
                             const results::Run& row) {
  std::vector<double> times;
  for (const Round& round : rounds) {
    const results::Run* const found = (round.*side).run(row.scene, row.detector);
    if (found == nullptr || found->times.empty()) return {};
    times.push_back(found->times.front().playback.frame);
    if (times.back() <= 0.0) return {};
  }
  return times;
}

void add_times(const std::vector<Round>& rounds, const AbLimits& limits, AbJudgement& judgement) {
  for (const results::Run& row : rounds.front().head.results().runs) {
    const results::Run* const was = rounds.front().base.run(row.scene, row.detector);
    if (was == nullptr) continue;
    const std::vector<double> base = times_of(rounds, &Round::base, row),
                              head = times_of(rounds, &Round::head, row);
    if (base.empty() || head.empty() || row.times.empty() ||
        was->times.front().question != row.times.front().question) {
      ++judgement.untimed;
      continue;
    }
    // The two times of a round were measured one after the other: a slow machine slows both.
    std::vector<double> ratios;
    for (std::size_t r = 0; r < rounds.size(); ++r) ratios.push_back(head[r] / base[r]);
    AbTime time = {row.scene,
                   row.detector,
                   mean_ratio(ratios),
                   geometric_mean(base),
                   geometric_mean(head),
                   AbVerdict::kPass};
    time.verdict = verdict_of(time, limits);
    judgement.times.push_back(std::move(time));
  }
  std::stable_sort(judgement.times.begin(), judgement.times.end(),
                   [](const AbTime& a, const AbTime& b) { return a.ratio.value > b.ratio.value; });
}

// One line per row, however many rounds differ.
void add_unsteady(const results::Index& first, const results::Index& later, const char* side,
                  std::vector<RowChange>& unsteady) {
  for (RowChange& change : accuracy_changes(first, later)) {
    change.detector += std::string(" in ") + side;
    const bool known = std::any_of(unsteady.begin(), unsteady.end(), [&](const RowChange& u) {
      return u.scene == change.scene && u.detector == change.detector;
    });
    if (!known) unsteady.push_back(std::move(change));
  }
}

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

Lines change_lines(const std::vector<RowChange>& changes,
                   std::optional<Direction> direction = std::nullopt) {
  Lines lines;
  for (const RowChange& change : changes)
    if (!direction || change.direction == *direction) lines.push_back(change_line(change));
  return lines;
}

// Within the limit and not faster, if that is wanted.
Lines equal_lines(const AbJudgement& judgement, const AbSetting& setting) {
  Lines lines;
  for (const AbTime& time : judgement.times)
    if (setting.two_detectors && time.verdict == AbVerdict::kPass &&
        !(time.ratio.high * setting.limits.slower_than < 1.0))
      lines.push_back(time_line(time));
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
          {std::string("Worse answers, base -> head") + allowed,
           change_lines(judgement.answers, Direction::kWorse)},
          {std::string("Better answers, base -> head") + allowed,
           change_lines(judgement.answers, Direction::kBetter)},
          {std::string("Other answers, base -> head") + allowed,
           change_lines(judgement.answers, Direction::kOther)},
          {std::string("Other answers from round to round of one build") + allowed,
           change_lines(judgement.unsteady)},
          {"Too noisy to judge: more rounds or a quieter machine would tell",
           lines_of(judgement, AbVerdict::kTooNoisy)},
          {"Faster", faster_lines(judgement, setting.limits)},
          {"Within the limit", equal_lines(judgement, setting)},
          {"Only in base", judgement.only_base},
          {"Only in head", judgement.only_head}};
}

std::string limits_text(const AbSetting& setting) {
  return fmt::format(
      "{} rounds in turns; time(head) / time(base), geometric mean and 95 % interval over rounds; "
      "allowed {:.2f}x, or {:g} us a frame",
      setting.rounds, setting.limits.slower_than, setting.limits.floor_us);
}

// "FAIL: 1 answer is worse, 2 times are within the limit." Answers first: of others a time says
// little.
std::string verdict_text(const AbJudgement& judgement, const AbSetting& setting) {
  std::vector<std::string> parts;
  const auto add = [&parts](std::size_t count, const char* one, const char* many) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
  };
  add(change_lines(judgement.answers, Direction::kWorse).size(), "answer is worse",
      "answers are worse");
  add(change_lines(judgement.answers, Direction::kBetter).size(), "answer is better",
      "answers are better");
  add(change_lines(judgement.answers, Direction::kOther).size(), "answer is another",
      "answers are others");
  add(judgement.unsteady.size(), "answer changes from round to round",
      "answers change from round to round");
  const bool compared = !judgement.times.empty() || judgement.untimed > 0;
  if (compared && parts.empty()) parts.emplace_back("answers are equal");
  const auto times = [&](AbVerdict verdict) { return lines_of(judgement, verdict).size(); };
  add(times(AbVerdict::kSlower), "time is too slow", "times are too slow");
  add(times(AbVerdict::kTooNoisy), "time is too noisy to judge", "times are too noisy to judge");
  add(times(AbVerdict::kPass), "time is within the limit", "times are within the limit");
  if (judgement.times.empty()) parts.emplace_back("nothing was timed");
  add(judgement.untimed, "row has no times", "rows have no times");
  const bool by_answers_alone = setting.fails(judgement) && judgement.answers_differ() &&
                                !judgement.slower() && !judgement.times.empty();
  return fmt::format("{}: {}.{}", setting.fails(judgement) ? "FAIL" : "PASS",
                     fmt::join(parts, ", "),
                     by_answers_alone ? " --accuracy-may-change allows it." : "");
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

bool AbJudgement::slower() const {
  return std::any_of(times.begin(), times.end(),
                     [](const AbTime& time) { return time.verdict == AbVerdict::kSlower; });
}

AbJudgement judge_ab(const std::vector<AbRound>& rounds, const AbLimits& limits) {
  CONTACTCHECK_INVARIANT(rounds.size() >= kFewestForInterval, "enough rounds for an interval");
  std::vector<Round> indexed;
  for (const AbRound& round : rounds)
    indexed.push_back({results::Index(round.base), results::Index(round.head)});
  const Round& first = indexed.front();
  AbJudgement judgement;
  add_times(indexed, limits, judgement);
  judgement.answers = accuracy_changes(first.base, first.head);
  for (const Round& round : indexed) {
    add_unsteady(first.base, round.base, "base", judgement.unsteady);
    add_unsteady(first.head, round.head, "head", judgement.unsteady);
  }
  judgement.only_base = missing_rows(first.head, first.base.results());
  judgement.only_head = missing_rows(first.base, first.head.results());
  return judgement;
}

std::string ab_text(const AbJudgement& judgement, const AbSetting& setting) {
  std::string text =
      fmt::format("base  {}\nhead  {}\n{}\n\n", setting.base, setting.head, limits_text(setting));
  for (const Section& section : sections_of(judgement, setting))
    text += section_text(section.title, section.lines);
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
  for (const auto& [direction, words] :
       {std::pair(Direction::kWorse, "worse"), std::pair(Direction::kBetter, "better"),
        std::pair(Direction::kOther, "other")})
    for (const std::string& line : change_lines(judgement.answers, direction))
      failures.push_back(fmt::format("{} answers than base: {}", words, line));
  for (const std::string& line : change_lines(judgement.unsteady))
    failures.push_back("other answers from round to round: " + line);
  return failures;
}

}  // namespace contactcheck::results
