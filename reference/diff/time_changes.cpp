#include "reference/diff/time_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace contactcheck {
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

}  // namespace contactcheck
