#include "reference/tune/search.h"

#include <algorithm>
#include <cmath>

#include "reference/tune/additive_model.h"

namespace contactcheck {
namespace {

// Whether the limits are met is a value of 1 or -1; what options do to it is seldom small.
constexpr EffectPriors kAccuracyPriors{1.0, 0.3, 0.3, 0.1};

class Search {
 public:
  Search(const std::vector<Candidate>& candidates, const Limits& limits,
         const SearchSettings& settings, const Measure& measure)
      : candidates_(candidates),
        limits_(limits),
        settings_(settings),
        measure_(measure),
        cost_(candidates, {}),
        accuracy_(candidates, kAccuracyPriors),
        open_(candidates.size(), true) {}

  SearchOutcome run() {
    try_all(first_batch());
    while (true) {
      std::vector<std::size_t> next = promising();
      if (next.empty()) break;
      next.resize(std::min(next.size(), settings_.batch));
      if (!try_all(next)) {
        out_.exhausted = true;
        break;
      }
    }
    return std::move(out_);
  }

 private:
  // Every detector as it is; where a space has none that is, its first candidate.
  std::vector<std::size_t> first_batch() const {
    std::vector<std::size_t> batch;
    std::vector<std::string> seen;
    for (const bool usual : {true, false})
      for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const std::string& id = candidates_[i].choices.front().value;
        if (candidates_[i].usual != usual || std::count(seen.begin(), seen.end(), id) > 0) continue;
        seen.push_back(id);
        batch.push_back(i);
      }
    return batch;
  }

  // False when not all of them may be measured any more.
  bool try_all(std::vector<std::size_t> batch) {
    const std::size_t most = settings_.most > 0 ? settings_.most : candidates_.size();
    const std::size_t left = most - std::min(most, out_.tried.size());
    const bool whole = batch.size() <= left;
    if (!whole) batch.resize(left);
    if (batch.empty()) return whole;
    const std::vector<Measurement> found = measure_(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) take(batch[i], found[i]);
    fit();
    return whole;
  }

  void take(std::size_t candidate, const Measurement& m) {
    open_[candidate] = false;
    out_.tried.push_back({candidate, m});
    const bool met = limits_.met_by(m);
    if (met && (!out_.best || m.cost_ms < out_.tried[*out_.best].measurement.cost_ms))
      out_.best = out_.tried.size() - 1;
    judged_.push_back(candidate);
    met_.push_back(met ? 1.0 : -1.0);
    const double detecting = m.cost_ms - candidates_[candidate].step_ms;
    if (!m.failure.empty() || !(detecting > 0.0)) return;
    timed_.push_back(candidate);
    log_cost_.push_back(std::log(detecting));
  }

  void fit() {
    accuracy_.fit(judged_, met_);
    if (!timed_.empty()) cost_.fit(timed_, log_cost_);
  }

  // Beside the best one a wrong guess costs most.
  double doubt_of(std::size_t candidate) const {
    if (!out_.best) return settings_.doubt;
    const std::vector<Choice>& best = candidates_[out_.tried[*out_.best].candidate].choices;
    const std::vector<Choice>& own = candidates_[candidate].choices;
    if (own.size() != best.size() || own.front() != best.front()) return settings_.doubt;
    std::size_t others = 0;
    for (std::size_t i = 1; i < own.size(); ++i) others += own[i] == best[i] ? 0 : 1;
    return others == 1 ? 2.0 * settings_.doubt : settings_.doubt;
  }

  // What may be cheaper than the best one and accurate enough, the most promising first.
  std::vector<std::size_t> promising() const {
    std::vector<std::pair<double, std::size_t>> ranked;
    if (timed_.empty()) return {};
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (!open_[i]) continue;
      const AdditiveModel::Guess cost = cost_.guess(i), accuracy = accuracy_.guess(i);
      const double doubt = doubt_of(i);
      const double at_best = std::exp(cost.mean - doubt * cost.deviation) + candidates_[i].step_ms;
      if (accuracy.mean + doubt * accuracy.deviation <= 0.0) continue;
      if (out_.best && at_best >= out_.tried[*out_.best].measurement.cost_ms) continue;
      // Before anything meets the limits, what does so is looked for.
      ranked.emplace_back(out_.best ? at_best : -accuracy.mean, i);
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<std::size_t> order;
    for (const auto& [rank, candidate] : ranked) order.push_back(candidate);
    return order;
  }

  const std::vector<Candidate>& candidates_;
  const Limits& limits_;
  const SearchSettings& settings_;
  const Measure& measure_;
  AdditiveModel cost_, accuracy_;
  std::vector<bool> open_;
  std::vector<std::size_t> judged_, timed_;
  std::vector<double> met_, log_cost_;
  SearchOutcome out_;
};

}  // namespace

SearchOutcome search(const std::vector<Candidate>& candidates, const Limits& limits,
                     const SearchSettings& settings, const Measure& measure) {
  return Search(candidates, limits, settings, measure).run();
}

std::vector<std::size_t> pareto_front(const std::vector<Tried>& tried) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const bool beaten = std::any_of(tried.begin(), tried.end(), [&](const Tried& other) {
      return dominates(other.measurement, tried[i].measurement);
    });
    if (!beaten && tried[i].measurement.failure.empty()) front.push_back(i);
  }
  std::sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
    return tried[a].measurement.cost_ms < tried[b].measurement.cost_ms;
  });
  return front;
}

}  // namespace contactcheck
