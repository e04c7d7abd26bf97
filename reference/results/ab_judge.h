// Has a change made a detector slower, or answer otherwise? Judged from runs of two builds that
// took turns.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reference/results/accuracy_changes.h"
#include "reference/results/results.h"

namespace contactcheck::results {

struct AbLimits {
  double slower_than = 1.1;  ///< time(head) / time(base) that is allowed
  double floor_us = 20.0;    ///< microseconds a frame that do not matter, whatever the ratio
};

/// An interval wider than this (high / low) that contains the limit says nothing.
inline constexpr double kNoisyWidth = 1.25;

enum class AbVerdict {
  kPass,      ///< not shown to be slower than allowed, or by less than the floor
  kSlower,    ///< all of the interval is beyond the limit, and the excess beyond the floor
  kTooNoisy,  ///< the limit lies inside a wide interval: it cannot be judged
};

/// One detector on one scene: its own question, in playback.
struct AbTime {
  std::string scene, detector;
  Ratio ratio;  ///< time(head) / time(base) over rounds (mean_ratio), below 1 is faster
  double base_ms = 0.0, head_ms = 0.0;  ///< geometric means over rounds, per frame
  AbVerdict verdict = AbVerdict::kPass;
};

struct AbRound {
  results::Results base, head;
};

struct AbJudgement {
  std::vector<AbTime> times;        ///< the largest ratio first
  std::vector<RowChange> answers;   ///< head's against base's
  std::vector<RowChange> unsteady;  ///< one build's against its own of an earlier round
  std::vector<std::string> only_base, only_head;  ///< scenes and detectors, in words
  /// Detectors on scenes that both have and that were timed in some rounds at most.
  std::size_t untimed = 0;

  bool slower() const;
  bool answers_differ() const { return !answers.empty() || !unsteady.empty(); }
};

/// @pre at least kFewestForInterval rounds
AbJudgement judge_ab(const std::vector<AbRound>& rounds, const AbLimits& limits);

}  // namespace contactcheck::results
