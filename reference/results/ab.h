// Whether a change made a detector slower or changed its answers: judged from runs of two builds
// that took turns, and written for a terminal or a job summary.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reference/results/accuracy_changes.h"
#include "reference/results/results.h"

namespace contactcheck::results {

struct AbLimits {
  double slower_than = 1.1;  ///< largest allowed time(head) / time(base)
  double floor_us = 20.0;    ///< differences below this many microseconds per frame are ignored
};

/// If an interval wider than this (high / low) contains the limit, nothing is concluded.
inline constexpr double kNoisyWidth = 1.25;

enum class AbVerdict {
  kPass,      ///< not shown to be slower than allowed, or by less than the floor
  kSlower,    ///< the whole interval is above the limit, and the excess above the floor
  kTooNoisy,  ///< the limit lies inside a wide interval
};

/// One detector on one scene: playback times of its own question.
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
  std::vector<AbTime> times;        ///< sorted by falling ratio
  std::vector<RowChange> answers;   ///< of head, compared with base
  std::vector<RowChange> unsteady;  ///< of one build, compared with its own earlier rounds
  std::vector<std::string> only_base, only_head;  ///< scenes and detectors, as text
  /// Detectors on scenes that both builds have but that were not timed in every round.
  std::size_t untimed = 0;

  bool slower() const;
  bool answers_differ() const { return !answers.empty() || !unsteady.empty(); }
};

/// @pre at least kFewestForInterval rounds
AbJudgement judge_ab(const std::vector<AbRound>& rounds, const AbLimits& limits);

/// The settings of a comparison, for the reader.
struct AbSetting {
  std::string base, head;  ///< the two programs
  std::size_t rounds = 0;
  AbLimits limits;
  bool accuracy_may_change = false;
  bool two_detectors = false;  ///< their ratio is told even where it is within the limit

  /// Also true if nothing could be compared.
  bool fails(const AbJudgement& judgement) const {
    return judgement.times.empty() || judgement.slower() ||
           (judgement.answers_differ() && !accuracy_may_change);
  }
};

/// One screen: first failures, then undecided ratios, then the rest, one line each or a count.
std::string ab_text(const AbJudgement& judgement, const AbSetting& setting);

/// The same as Markdown, with all times in a table, for a job summary.
std::string ab_markdown(const AbJudgement& judgement, const AbSetting& setting);

/// One sentence per reason to fail; empty if there is none.
std::vector<std::string> ab_failures(const AbJudgement& judgement, const AbSetting& setting);

}  // namespace contactcheck::results
