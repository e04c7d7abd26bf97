// What a candidate costs and how wrong it is, and what is allowed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reference/results/results.h"
#include "reference/results/statistics.h"
#include "reference/tune/candidate.h"

namespace contactcheck::tune {

/// What all measurements in one model (a lattice, a deformer) share. Where it is uncertain, all of
/// them are too dear or too cheap together.
struct ModelCost {
  results::Ratio anchor_ms{1.0, 1.0, 1.0};  ///< what the anchor takes for a frame of it
  Cost step;                                ///< TuneCandidate::step
};

struct Measurement {
  std::string failure;  ///< not empty: it gave no answer or no time, and nothing else is set
  /// Map, update and query in playback, in times what the anchor takes in the same model, with its
  /// interval (paired_cost.h).
  results::Ratio beside_anchor;
  /// One object for all measurements in a model, which later runs correct. None: the anchor takes
  /// 1 ms, and a step nothing.
  std::shared_ptr<const ModelCost> model;
  std::uint64_t missed = 0, spurious = 0;  ///< at the level of the question, over all frames
  std::optional<double> hover;             ///< metres; none without an episode
  std::optional<long> late_frames;
  double deviation = 0.0;  ///< metres: how far the model takes a vertex from where the scene's does
  /// Where its detector is known to be right, and how large the scene is (results::outside).
  std::vector<results::ScaleRange> ranges;
  std::optional<results::SceneScale> scale;

  /// Per frame, TuneCandidate::step included; its interval has the uncertainty of the model too. By
  /// what is known of the model now; 0 of a failure.
  Cost cost() const;
};

/// Nothing set: nothing asked for.
struct Limits {
  std::optional<std::uint64_t> missed, spurious;
  std::optional<double> hover, deviation;  ///< metres
  std::optional<long> late_frames;         ///< of either sign

  bool met_by(const Measurement& m) const;
};

/// True if it is unknown which is cheaper: the intervals overlap. Within a model the ratios to the
/// anchor are compared, since the rest is the same for both; across models the whole costs. Always
/// false for a failure, which has no cost.
bool as_cheap_within_noise(const Measurement& a, const Measurement& b);

/// No more expensive or wrong in anything, and better in something. A failure dominates nothing.
bool dominates(const Measurement& a, const Measurement& b);

}  // namespace contactcheck::tune
