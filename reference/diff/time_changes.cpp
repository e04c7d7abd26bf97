#include "reference/diff/time_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace contactcheck {
namespace {

double log_size(const TimeChange& change) { return std::fabs(std::log(change.factor.value)); }

bool usable(const Ratio& r) { return r.low > 0.0 && r.value > 0.0 && r.high > 0.0; }

std::optional<TimeChange> change_of(const ResultRow& was, const ResultRow& is) {
  for (const auto& [reference, now] : is.speedups) {
    if (reference == is.detector) continue;
    for (const auto& [name, then] : was.speedups)
      if (name == reference && usable(now) && usable(then))
        return TimeChange{is.scene, is.detector, reference, quotient(now, then)};
  }
  return std::nullopt;
}

bool is_clear(const Ratio& factor) {
  const bool one_sided = factor.low > 1.0 || factor.high < 1.0;
  return one_sided && std::fabs(std::log(factor.value)) > std::log1p(kSmallestTimeChange);
}

}  // namespace

std::vector<TimeChange> time_changes(const ResultTable& before, const ResultTable& after) {
  std::vector<TimeChange> changes;
  for (const ResultRow& row : after.rows) {
    const ResultRow* was = before.find(row.scene, row.detector);
    if (was == nullptr) continue;
    const std::optional<TimeChange> change = change_of(*was, row);
    if (change && is_clear(change->factor)) changes.push_back(*change);
  }
  std::stable_sort(changes.begin(), changes.end(), [](const TimeChange& a, const TimeChange& b) {
    return log_size(a) > log_size(b);
  });
  return changes;
}

}  // namespace contactcheck
