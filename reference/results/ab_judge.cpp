#include "reference/results/ab_judge.h"

#include <algorithm>

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

// The two times of a round were measured one after the other: a slow machine slows both.
Ratio ratio_by_round(const std::vector<double>& base, const std::vector<double>& head) {
  std::vector<double> ratios;
  for (std::size_t r = 0; r < base.size(); ++r) ratios.push_back(head[r] / base[r]);
  return mean_ratio(ratios);
}

bool same_question(const results::Run& a, const results::Run& b) {
  return !a.times.empty() && !b.times.empty() &&
         a.times.front().question == b.times.front().question;
}

void add_times(const std::vector<Round>& rounds, const AbLimits& limits, AbJudgement& judgement) {
  for (const results::Run& row : rounds.front().head.results().runs) {
    const results::Run* const was = rounds.front().base.run(row.scene, row.detector);
    if (was == nullptr) continue;
    const std::vector<double> base = times_of(rounds, &Round::base, row),
                              head = times_of(rounds, &Round::head, row);
    if (base.empty() || head.empty() || !same_question(*was, row)) {
      ++judgement.untimed;
      continue;
    }
    AbTime time = {row.scene,
                   row.detector,
                   ratio_by_round(base, head),
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

}  // namespace contactcheck::results
