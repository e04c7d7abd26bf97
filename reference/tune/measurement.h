// What a candidate costs and how wrong it is, and what is allowed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace contactcheck {

struct Measurement {
  std::string failure;  ///< not empty: it gave no answer or no time, and nothing else is set
  /// Per frame: map, update and query with cold caches; and Candidate::step.
  double cost_ms = 0.0;
  double cost_low_ms = 0.0, cost_high_ms = 0.0;  ///< 95 % interval of it (paired_cost.h)
  std::uint64_t missed = 0, spurious = 0;        ///< at the level of the question, over all frames
  std::optional<double> hover;                   ///< metres; none without an episode
  std::optional<long> late_frames;
  double deviation = 0.0;  ///< metres: how far the model takes a vertex from where the scene's does
};

/// Nothing set: nothing asked for.
struct Limits {
  std::optional<std::uint64_t> missed, spurious;
  std::optional<double> hover, deviation;  ///< metres
  std::optional<long> late_frames;         ///< of either sign

  bool met_by(const Measurement& m) const;
};

/// Their intervals of the cost overlap: which of them is cheaper is not known. A failure costs
/// nothing that could be compared.
bool as_cheap_within_noise(const Measurement& a, const Measurement& b);

/// No dearer and no more wrong in anything, and better in something. A failure dominates nothing.
bool dominates(const Measurement& a, const Measurement& b);

}  // namespace contactcheck
