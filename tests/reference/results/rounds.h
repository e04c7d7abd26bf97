// Rounds of two builds, written by hand.
#pragma once

#include "reference/results/ab.h"
#include "tests/reference/results/hand_results.h"

namespace contactcheck::test {

/// One scene "s" and one detector "d", with these times per round, in milliseconds.
inline std::vector<results::AbRound> rounds_of(const std::vector<double>& base,
                                               const std::vector<double>& head) {
  std::vector<results::AbRound> rounds;
  for (std::size_t i = 0; i < base.size(); ++i)
    rounds.push_back(
        {results_of({timed_run("s", "d", base[i])}), results_of({timed_run("s", "d", head[i])})});
  return rounds;
}

/// The same time in each of seven rounds.
inline std::vector<results::AbRound> steady_rounds(double base_ms, double head_ms) {
  return rounds_of(std::vector<double>(7, base_ms), std::vector<double>(7, head_ms));
}

}  // namespace contactcheck::test
