#include "reference/tune/search.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "reference/tune/candidate.h"

namespace contactcheck::tune {
namespace {

// Guesses the value of candidates that were not measured from those that were: every choice adds an
// effect, and a smaller one in combination with its detector.
//
// Bayesian linear regression with a normal prior on every effect (Bishop, Pattern Recognition and
// Machine Learning, 2006, 3.3): few measurements give wide guesses, and a choice that was never
// tried is as uncertain as the prior says.

/// Standard deviations of the effects, in units of the value that is modelled.
struct EffectPriors {
  double detector = 2.0;     ///< of the detector itself
  double choice = 0.5;       ///< of another choice
  double interaction = 0.2;  ///< of a choice for one detector
  double noise = 0.05;       ///< of a measurement
};

class AdditiveModel {
 public:
  /// `candidates` must outlive it.
  AdditiveModel(const std::vector<TuneCandidate>& candidates, const EffectPriors& priors);

  /// Forgets earlier fits. @pre as many values as indices, at least one, all finite
  void fit(std::span<const std::size_t> measured, std::span<const double> values);

  struct Guess {
    double mean = 0.0, deviation = 0.0;
  };
  /// @pre fit was called
  Guess guess(std::size_t candidate) const;

 private:
  std::vector<std::vector<std::pair<Eigen::Index, double>>> features_;  ///< [candidate]
  Eigen::Index size_ = 0;
  double noise_;
  double centre_ = 0.0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
};

AdditiveModel::AdditiveModel(const std::vector<TuneCandidate>& candidates,
                             const EffectPriors& priors)
    : noise_(priors.noise) {
  std::map<std::string, Eigen::Index> columns;
  const auto column = [&](const std::string& name) {
    return columns.emplace(name, static_cast<Eigen::Index>(columns.size())).first->second;
  };
  for (const TuneCandidate& candidate : candidates) {
    auto& row = features_.emplace_back();
    const std::string& detector = candidate.choices.front().value;
    row.emplace_back(column(detector), priors.detector);
    for (std::size_t i = 1; i < candidate.choices.size(); ++i) {
      const std::string choice = candidate.choices[i].axis + "=" + candidate.choices[i].value;
      row.emplace_back(column(choice), priors.choice);
      row.emplace_back(column(detector + " " + choice), priors.interaction);
    }
  }
  size_ = static_cast<Eigen::Index>(columns.size());
}

void AdditiveModel::fit(std::span<const std::size_t> measured, std::span<const double> values) {
  CONTACTCHECK_INVARIANT(!measured.empty() && measured.size() == values.size(),
                         "a fit needs a value for each index");
  centre_ = 0.0;
  for (const double value : values) centre_ += value / static_cast<double>(values.size());
  Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(size_, size_);
  Eigen::VectorXd weighted = Eigen::VectorXd::Zero(size_);
  const double weight = 1.0 / (noise_ * noise_);
  for (std::size_t i = 0; i < measured.size(); ++i)
    for (const auto& [a, x] : features_[measured[i]]) {
      weighted[a] += weight * x * (values[i] - centre_);
      for (const auto& [b, y] : features_[measured[i]]) precision(a, b) += weight * x * y;
    }
  covariance_ = precision.llt().solve(Eigen::MatrixXd::Identity(size_, size_));
  mean_ = covariance_ * weighted;
}

AdditiveModel::Guess AdditiveModel::guess(std::size_t candidate) const {
  Guess guess{centre_, 0.0};
  double variance = 0.0;
  for (const auto& [a, x] : features_[candidate]) {
    guess.mean += x * mean_[a];
    for (const auto& [b, y] : features_[candidate]) variance += x * y * covariance_(a, b);
  }
  guess.deviation = std::sqrt(std::max(variance, 0.0));
  return guess;
}

// Whether the limits are met is a value of 1 or -1; what options do to it is seldom small.
constexpr EffectPriors kAccuracyPriors{1.0, 0.3, 0.3, 0.1};

// Races stay within a fifth of the candidates, or within kFewMeasurements where there are few.
constexpr std::size_t kShareOfMeasurements = 5, kFewMeasurements = 24;

class Search {
 public:
  Search(const std::vector<TuneCandidate>& candidates, const Limits& limits,
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
    do {
      explore();
    } while (!out_.exhausted && race());
    return std::move(out_);
  }

 private:
  void explore() {
    for (auto next = promising(); !next.empty(); next = promising()) {
      next.resize(std::min(next.size(), settings_.batch));
      if (try_all(next)) continue;
      out_.exhausted = true;
      return;
    }
  }

  // One round: the best one beside the cheapest of those that cannot be told from it.
  bool race() {
    if (!out_.best || rounds_ == settings_.races) return false;
    std::vector<std::size_t> runners = as_cheap_as(*out_.best, out_.tried, limits_);
    runners.insert(runners.begin(), *out_.best);
    runners.resize(std::min({runners.size(), settings_.batch, left_for_a_race()}));
    if (runners.size() < 2) return false;
    ++rounds_;
    std::vector<std::size_t> batch;
    for (const std::size_t i : runners) batch.push_back(out_.tried[i].candidate);
    const std::vector<Measurement> found = measure_(batch);
    out_.measurements += batch.size();
    for (std::size_t k = 0; k < runners.size(); ++k) {
      out_.tried[runners[k]].measurement = found[k];
      ++out_.tried[runners[k]].times;
    }
    out_.best = cheapest(out_.tried, limits_);
    fit();
    return true;
  }

  std::size_t left_for_a_race() const {
    const std::size_t share = std::max(candidates_.size() / kShareOfMeasurements, kFewMeasurements);
    const std::size_t most = settings_.most > 0 ? settings_.most : share;
    return most - std::min(most, out_.measurements);
  }

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
    const std::size_t most =
        settings_.most > 0 ? settings_.most : out_.measurements + candidates_.size();
    const std::size_t left = most - std::min(most, out_.measurements);
    const bool whole = batch.size() <= left;
    if (!whole) batch.resize(left);
    if (batch.empty()) return whole;
    const std::vector<Measurement> found = measure_(batch);
    out_.measurements += batch.size();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      open_[batch[i]] = false;
      out_.tried.push_back({batch[i], found[i]});
    }
    out_.best = cheapest(out_.tried, limits_);
    fit();
    return whole;
  }

  void fit() {
    std::vector<std::size_t> judged, timed;
    std::vector<double> met, log_cost;
    for (const Tried& tried : out_.tried) {
      const Measurement& m = tried.measurement;
      judged.push_back(tried.candidate);
      met.push_back(limits_.met_by(m) ? 1.0 : -1.0);
      const double detecting = m.cost().ms - candidates_[tried.candidate].step.ms;
      if (!m.failure.empty() || !(detecting > 0.0)) continue;
      timed.push_back(tried.candidate);
      log_cost.push_back(std::log(detecting));
    }
    accuracy_.fit(judged, met);
    has_costs_ = !timed.empty();
    if (has_costs_) cost_.fit(timed, log_cost);
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
    if (!has_costs_) return {};
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (!open_[i]) continue;
      const AdditiveModel::Guess cost = cost_.guess(i), accuracy = accuracy_.guess(i);
      const double doubt = doubt_of(i);
      const double at_best = std::exp(cost.mean - doubt * cost.deviation) + candidates_[i].step.ms;
      if (accuracy.mean + doubt * accuracy.deviation <= 0.0) continue;
      if (out_.best && at_best >= out_.tried[*out_.best].measurement.cost().ms) continue;
      // Before anything meets the limits, what does so is looked for.
      ranked.emplace_back(out_.best ? at_best : -accuracy.mean, i);
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<std::size_t> order;
    for (const auto& [rank, candidate] : ranked) order.push_back(candidate);
    return order;
  }

  const std::vector<TuneCandidate>& candidates_;
  const Limits& limits_;
  const SearchSettings& settings_;
  const Measure& measure_;
  AdditiveModel cost_, accuracy_;
  std::vector<bool> open_;
  bool has_costs_ = false;  ///< one was timed at least
  std::size_t rounds_ = 0;  ///< of the race
  SearchOutcome out_;
};

}  // namespace

std::optional<std::size_t> cheapest(const std::vector<Tried>& tried, const Limits& limits) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (limits.met_by(tried[i].measurement) &&
        (!best || tried[i].measurement.cost().ms < tried[*best].measurement.cost().ms))
      best = i;
  return best;
}

std::vector<std::size_t> as_cheap_as(std::size_t best, const std::vector<Tried>& tried,
                                     const Limits& limits) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (i != best && limits.met_by(tried[i].measurement) &&
        as_cheap_within_noise(tried[i].measurement, tried[best].measurement))
      found.push_back(i);
  std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return tried[a].measurement.cost().ms < tried[b].measurement.cost().ms;
  });
  return found;
}

SearchOutcome search(const std::vector<TuneCandidate>& candidates, const Limits& limits,
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
    return tried[a].measurement.cost().ms < tried[b].measurement.cost().ms;
  });
  return front;
}

}  // namespace contactcheck::tune
