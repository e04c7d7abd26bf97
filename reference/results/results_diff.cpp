#include "reference/results/results_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace contactcheck::results {
namespace {

double log_size(const TimeChange& change) { return std::fabs(std::log(change.factor.value)); }

bool usable(const Ratio& r) { return r.low > 0.0 && r.value > 0.0 && r.high > 0.0; }

using Speedups = std::map<std::string, results::Speedup>;

// In the question that most detectors can be asked.
const Speedups* compared_speedups(const results::Run& run) {
  for (const Question question :
       {Question::kTriangles, Question::kBody, Question::kContacts, Question::kCells})
    if (const auto it = run.speedup.find(question); it != run.speedup.end()) return &it->second;
  return nullptr;
}

std::optional<TimeChange> change_of(const results::Run& was, const results::Run& is) {
  const Speedups *before = compared_speedups(was), *after = compared_speedups(is);
  if (before == nullptr || after == nullptr) return std::nullopt;
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

// What times depend on.
std::vector<std::string> machine_changes(const results::Machine& before,
                                         const results::Machine& after) {
  std::vector<std::string> out;
  const auto compare = [&](const char* what, const std::string& was, const std::string& is) {
    if (was != is) out.push_back(fmt::format("{} \"{}\" -> \"{}\"", what, was, is));
  };
  compare("cpu", before.cpu, after.cpu);
  compare("isa", before.isa, after.isa);
  compare("compiler", before.compiler, after.compiler);
  compare("build", before.build, after.build);
  return out;
}

std::vector<std::string> changed_scenes(const results::Index& before,
                                        const results::Results& after) {
  std::vector<std::string> out;
  for (const results::Scene& scene : after.scenes) {
    const results::Scene* const was = before.scene(scene.id);
    if (was != nullptr && was->truth_hash != scene.truth_hash) out.push_back(scene.id);
  }
  std::sort(out.begin(), out.end());
  return out;
}

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

std::string plural(std::size_t n, const char* one) {
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
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
    out.push_back(fmt::format("scene {} ({})", name, plural(n, "detector")));
  for (const auto& [name, n] : detectors)
    out.push_back(fmt::format("detector {} (in {})", name, plural(n, "scene")));
  return out;
}

ResultsDiff diff_results(const results::Results& before, const results::Results& after) {
  const results::Index was(before), is(after);
  ResultsDiff diff;
  diff.machine = machine_changes(before.machine, after.machine);
  diff.other_scenes = changed_scenes(was, after);
  diff.changes = accuracy_changes(was, is);
  diff.times = time_changes(was, after);
  diff.added = missing_rows(was, after);
  diff.gone = missing_rows(is, before);
  for (const results::Run& row : after.runs)
    if (was.run(row.scene, row.detector) != nullptr) ++diff.common;
  return diff;
}

}  // namespace contactcheck::results
