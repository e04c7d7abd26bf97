// The cheapest candidate that is accurate enough, found without measuring them all.
//
// Every detector is measured once as it is. Then, batch by batch, what may still be cheaper than
// the best one found: two additive models (additive_model.h), of the logarithm of the cost and of
// whether the limits are met, say how cheap and how accurate each of the others may be at best.
// What a step of the simulation costs is known beforehand and comes on top of the model's guess.
// The search ends when none of them may be cheaper.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "reference/tune/candidate.h"
#include "reference/tune/measurement.h"

namespace contactcheck {

struct SearchSettings {
  std::size_t batch = 4;  ///< measured together
  std::size_t most = 0;   ///< candidates that are measured at most; 0: as many as there are
  /// Standard deviations by which a guess may be wrong; twice as many beside the best one.
  double doubt = 1.5;
};

struct Tried {
  std::size_t candidate = 0;
  Measurement measurement;
};

struct SearchOutcome {
  std::vector<Tried> tried;         ///< in the order of measuring
  std::optional<std::size_t> best;  ///< index into `tried`; none met the limits
  bool exhausted = false;           ///< ended by `most`, with candidates left that may be cheaper
};

/// Measures candidates; as many answers in the same order.
using Measure = std::function<std::vector<Measurement>(const std::vector<std::size_t>&)>;

/// @pre candidates is not empty; each has a choice on the axis "detector"
SearchOutcome search(const std::vector<Candidate>& candidates, const Limits& limits,
                     const SearchSettings& settings, const Measure& measure);

/// Of what was tried, what nothing else tried dominates, by cost.
std::vector<std::size_t> pareto_front(const std::vector<Tried>& tried);

}  // namespace contactcheck
