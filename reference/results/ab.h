// Has a change made a detector slower, or answer differently? Judged from runs of two builds that
// took turns, and written for a terminal or a job summary.
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

/// What was run, for the reader.
struct AbSetting {
  std::string base, head;  ///< the two programs
  std::size_t rounds = 0;
  AbLimits limits;
  bool accuracy_may_change = false;

  /// Also where nothing could be compared: that is no pass.
  bool fails(const AbJudgement& judgement) const {
    return judgement.times.empty() || judgement.slower() ||
           (judgement.answers_differ() && !accuracy_may_change);
  }
};

/// One screen: what fails first, then what cannot be judged, then the rest in a line each or a
/// count.
std::string ab_text(const AbJudgement& judgement, const AbSetting& setting);

/// The same as Markdown, with all times in a table, for a job summary.
std::string ab_markdown(const AbJudgement& judgement, const AbSetting& setting);

/// One sentence per reason to fail; empty when there is none.
std::vector<std::string> ab_failures(const AbJudgement& judgement, const AbSetting& setting);

}  // namespace contactcheck::results
