// Grids of candidates whose cost and accuracy are known, to hold the search against.
#pragma once

#include <random>
#include <vector>

#include "reference/tune/search.h"

namespace contactcheck::test {

inline tune::Limits nothing_missed() {
  tune::Limits limits;
  limits.missed = 0;
  return limits;
}

struct Grid {
  std::vector<tune::TuneCandidate> candidates;
  std::vector<tune::Measurement> truth;  ///< of each

  tune::Measure measure() const {
    return [this](const std::vector<std::size_t>& batch) {
      std::vector<tune::Measurement> out;
      for (const std::size_t i : batch) out.push_back(truth[i]);
      return out;
    };
  }

  /// The cheapest that meets the limits: what measuring everything finds.
  std::optional<std::size_t> best(const tune::Limits& limits) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < truth.size(); ++i)
      if (limits.met_by(truth[i]) && (!best || truth[i].cost().ms < truth[*best].cost().ms))
        best = i;
    return best;
  }
};

/// 5 detectors x 2 readings x 5 cells x 4 tables = 200. Costs are products of random effects, with
/// a little of its own for every detector and choice, and noise; the reading "loose" and detectors
/// 3 and 4 miss contacts.
inline Grid random_grid(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const std::vector<std::vector<std::string>> axes = {
      {"first", "second", "third", "fourth", "fifth"},
      {"safe", "loose"},
      {"1", "0.5", "2", "4", "0.25"},
      {"0", "64", "256", "1024"}};
  const char* names[] = {"detector", "bounds", "cell", "table"};
  std::vector<std::vector<double>> effects(4);
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (std::size_t v = 0; v < axes[a].size(); ++v)
      effects[a].push_back((a == 0 ? 1.0 : 0.3) * normal(random));
  double own[5][5][2];
  for (auto& detector : own)
    for (auto& cell : detector)
      for (double& effect : cell) effect = 0.1 * normal(random);
  Grid grid;
  for (std::size_t i = 0; i < 200; ++i) {
    const std::size_t value[] = {i / 40, i / 20 % 2, i / 4 % 5, i % 4};
    tune::TuneCandidate candidate;
    double log_cost = own[value[0]][value[2]][value[1]] + 0.01 * normal(random);
    for (std::size_t a = 0; a < 4; ++a) {
      candidate.choices.push_back({names[a], axes[a][value[a]]});
      log_cost += effects[a][value[a]];
    }
    candidate.detector = axes[0][value[0]] + ":" + std::to_string(i);
    candidate.usual = value[1] == 0 && value[2] == 0 && value[3] == 0;
    tune::Measurement m;
    const double cost = std::exp(log_cost);
    m.beside_anchor = {cost, cost, cost};
    m.missed = value[1] == 1 || value[0] >= 3 ? 7 : 0;
    grid.candidates.push_back(candidate);
    grid.truth.push_back(m);
  }
  return grid;
}

}  // namespace contactcheck::test
