#include "reference/results/results_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "reference/text/counted.h"
#include "reference/text/lists.h"

namespace contactcheck::results {
namespace {

double log_size(const TimeChange& change) { return std::fabs(std::log(change.factor.value)); }

bool usable(const Ratio& r) { return r.low > 0.0 && r.value > 0.0 && r.high > 0.0; }

using Speedups = std::map<std::string, results::Speedup>;

std::optional<TimeChange> change_of(const results::Run& was, const results::Run& is) {
  const Speedups *before = nullptr, *after = nullptr;
  for (const Question question : kQuestions) {  // the first that both were timed in
    const auto then = was.speedup.find(question), now = is.speedup.find(question);
    if (then == was.speedup.end() || now == is.speedup.end()) continue;
    before = &then->second;
    after = &now->second;
    break;
  }
  if (after == nullptr) return std::nullopt;
  for (const auto& [reference, now] : *after) {
    if (reference == is.detector) continue;
    const auto then = before->find(reference);
    if (then == before->end() || !usable(now.playback) || !usable(then->second.playback)) continue;
    const std::size_t passes = std::min(now.passes, then->second.passes);
    return TimeChange{is.scene, is.detector, reference,
                      quotient(now.playback, then->second.playback, passes), passes};
  }
  return std::nullopt;
}

bool is_clear(const TimeChange& change) {
  const Ratio& factor = change.factor;
  if (change.passes < kFewestForInterval)
    return factor.low > kRangeFactor || factor.high < 1.0 / kRangeFactor;
  const bool one_sided = factor.low > 1.0 || factor.high < 1.0;
  return one_sided && log_size(change) > std::log1p(kSmallestTimeChange);
}

}  // namespace

std::vector<TimeChange> time_changes(const results::Index& before, const results::Results& after) {
  std::vector<TimeChange> changes;
  for (const results::Run& row : after.runs) {
    const results::Run* was = before.run(row.scene, row.detector);
    if (was == nullptr) continue;
    const std::optional<TimeChange> change = change_of(*was, row);
    if (change && is_clear(*change)) changes.push_back(*change);
  }
  std::stable_sort(changes.begin(), changes.end(), [](const TimeChange& a, const TimeChange& b) {
    return log_size(a) > log_size(b);
  });
  return changes;
}

namespace {

using Counts = std::vector<std::pair<std::string, std::size_t>>;

void count(const std::string& name, Counts& counts) {
  const auto it = std::find_if(counts.begin(), counts.end(),
                               [&](const auto& entry) { return entry.first == name; });
  if (it == counts.end()) {
    counts.emplace_back(name, 1);
  } else {
    ++it->second;
  }
}

}  // namespace

std::vector<std::string> missing_rows(const results::Index& results,
                                      const results::Results& other) {
  Counts scenes, detectors;
  for (const results::Run& row : other.runs) {
    if (results.runs_of(row.scene).empty()) {
      count(row.scene, scenes);
    } else if (results.run(row.scene, row.detector) == nullptr) {
      count(row.detector, detectors);
    }
  }
  std::vector<std::string> out;
  for (const auto& [name, n] : scenes)
    out.push_back(fmt::format("scene {} ({})", name, text::counted(n, "detector")));
  for (const auto& [name, n] : detectors)
    out.push_back(fmt::format("detector {} (in {})", name, text::counted(n, "scene")));
  return out;
}

ResultsDiff diff_results(const results::Results& before, const results::Results& after) {
  const results::Index was(before), is(after);
  ResultsDiff diff;
  // Times depend on these.
  const auto compare_machines = [&](const char* what, std::string results::Machine::*member) {
    const std::string &then = before.machine.*member, &now = after.machine.*member;
    if (then != now) diff.machine.push_back(fmt::format("{} \"{}\" -> \"{}\"", what, then, now));
  };
  compare_machines("cpu", &results::Machine::cpu);
  compare_machines("isa", &results::Machine::isa);
  compare_machines("compiler", &results::Machine::compiler);
  compare_machines("build", &results::Machine::build);
  for (const results::Scene& scene : after.scenes)
    if (const results::Scene* const old = was.scene(scene.id);
        old != nullptr && old->truth_hash != scene.truth_hash)
      diff.other_scenes.push_back(scene.id);
  std::sort(diff.other_scenes.begin(), diff.other_scenes.end());
  diff.changes = accuracy_changes(was, is);
  diff.times = time_changes(was, after);
  diff.added = missing_rows(was, after);
  diff.gone = missing_rows(is, before);
  for (const results::Run& row : after.runs)
    if (was.run(row.scene, row.detector) != nullptr) ++diff.common;
  return diff;
}

std::string change_line(const RowChange& change) {
  // A row may differ at every level and in every error.
  constexpr std::size_t kDifferencesPerLine = 3;
  std::string what = text::first_joined(change.what, kDifferencesPerLine);
  if (change.what.size() > kDifferencesPerLine)
    what += fmt::format(", and {} more", change.what.size() - kDifferencesPerLine);
  return fmt::format("{}  {}  {}", change.scene, change.detector, what);
}

std::string section_text(const std::string& title, const std::vector<std::string>& lines) {
  constexpr std::size_t kLinesPerSection = 5;
  if (lines.empty()) return "";
  std::string text = fmt::format("{} ({})\n", title, lines.size());
  for (std::size_t i = 0; i < std::min(lines.size(), kLinesPerSection); ++i)
    text += "  " + lines[i] + "\n";
  if (lines.size() > kLinesPerSection)
    text += fmt::format("  ... and {} more\n", lines.size() - kLinesPerSection);
  return text;
}

std::string diff_text(const ResultsDiff& diff) {
  std::vector<std::string> worse, better, other, slower, faster;
  for (const RowChange& change : diff.changes)
    (change.direction == Direction::kWorse    ? worse
     : change.direction == Direction::kBetter ? better
                                              : other)
        .push_back(change_line(change));
  // "1.32x [1.28, 1.36] slower, measured against fcl-aabb".
  for (const TimeChange& change : diff.times) {
    Ratio f = change.factor;
    const bool is_slower = f.value < 1.0;
    if (is_slower) f = {1.0 / f.value, 1.0 / f.high, 1.0 / f.low};
    (is_slower ? slower : faster)
        .push_back(fmt::format("{}  {}  {} {}, measured against {}", change.scene, change.detector,
                               ratio_text(f, change.passes), is_slower ? "slower" : "faster",
                               change.reference));
  }
  return section_text("Another machine: times compare ratios, but caches and instructions differ",
                      diff.machine) +
         section_text("Another scene of the same name: its exact truth differs",
                      diff.other_scenes) +
         section_text("Worse", worse) + section_text("Better", better) +
         section_text("Other answers, neither better nor worse", other) +
         section_text("Slower", slower) + section_text("Faster", faster) +
         section_text("New", diff.added) + section_text("Gone", diff.gone) +
         fmt::format("{} of {} common rows have the same answers; {} differ clearly in time.\n",
                     diff.common - diff.changes.size(), diff.common, diff.times.size());
}

}  // namespace contactcheck::results
