// The cheapest candidate that is accurate enough, found without measuring them all.
//
// Every detector is measured once as it is. Then, batch by batch, what may still be cheaper than
// the best one found: two additive models, of the logarithm of the cost and of
// whether the limits are met, say how cheap and how accurate each of the others may be at best.
// What a step of the simulation costs is known beforehand and comes on top of the model's guess.
// When none of them may be cheaper, the best one races: it is measured again beside those whose
// cost cannot be told from its own, since the cheapest of many noisy costs is one that noise has
// made too cheap. Where that changes what the models say, the search goes on. It ends when nothing
// may be cheaper and the race is decided, or its rounds or measurements are used up.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "reference/tune/candidate.h"
#include "reference/tune/measurement.h"

namespace contactcheck::tune {

struct SearchSettings {
  std::size_t batch = 4;  ///< measured together
  /// Measurements at most, those of a race too. 0: whatever may be cheaper is measured, and races
  /// only while all measurements are within a fifth of the candidates, or 24 where there are few.
  std::size_t most = 0;
  std::size_t races = 3;  ///< rounds of measuring again at most
  /// Standard deviations by which a guess may be wrong; twice as many beside the best one.
  double doubt = 1.5;
};

struct Tried {
  std::size_t candidate = 0;
  Measurement measurement;  ///< the last one
  std::size_t times = 1;    ///< that it was measured
};

struct SearchOutcome {
  std::vector<Tried> tried;         ///< in the order of measuring, each candidate once
  std::optional<std::size_t> best;  ///< index into `tried`; none met the limits
  bool exhausted = false;           ///< ended by `most`, with candidates left that may be cheaper
  std::size_t measurements = 0;     ///< of all in `tried`, races included
};

/// Measures candidates; as many answers in the same order. One that is measured again is answered
/// for with all that was measured of it.
using Measure = std::function<std::vector<Measurement>(const std::vector<std::size_t>&)>;

/// @pre candidates is not empty; each has a choice on the axis "detector"
SearchOutcome search(const std::vector<TuneCandidate>& candidates, const Limits& limits,
                     const SearchSettings& settings, const Measure& measure);

/// Index of the cheapest that meets the limits; nothing if none does.
std::optional<std::size_t> cheapest(const std::vector<Tried>& tried, const Limits& limits);

/// Indices of the others that meet the limits and whose costs do not differ significantly, the
/// cheapest first.
std::vector<std::size_t> as_cheap_as(std::size_t best, const std::vector<Tried>& tried,
                                     const Limits& limits);

/// The tried candidates that no other one dominates, by cost.
std::vector<std::size_t> pareto_front(const std::vector<Tried>& tried);

}  // namespace contactcheck::tune
