// Ratios of times out of results, and whether two runs may be compared by them.
#pragma once

#include <cstddef>
#include <string>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"
#include "reference/results/statistics.h"

namespace contactcheck::gate {

// When a ratio of times is beyond its limit: on plain numbers, so that a simulation can ask it.

/// A detector's time over the longest time that its limit allows: beyond 1 it is too slow. Of the
/// upper limit of a speed-up, it is the reference that may not be too slow.
struct Slowness {
  results::Ratio ratio;
  double frame_us = 0.0;   ///< the time per frame of whoever may be too slow
  std::size_t passes = 0;  ///< behind the ratio: they tell what its ends are (interval_name)
};

/// How the rule may judge it; as in a policy.
struct TimingTolerance {
  double floor_us = 0.0, noise_width = 0.0;
};

struct TimingVerdict {
  Verdict verdict = Verdict::kPass;
  double excess_us = 0.0;  ///< per frame above what is allowed; 0 where nothing is
  std::string reason;      ///< unless it is fast enough or cannot be judged
};

/// With an interval: fails when all of it is beyond 1 and the excess per frame reaches the floor.
/// Too noisy when 1 lies inside an interval that is wider than the noise width: whether it would
/// have failed is a matter of luck then. Passes else.
/// With a range: fails when all of it is beyond kRangeFactor and the excess reaches the floor,
/// passes when all of it is below 1 / kRangeFactor or the frame is shorter than the floor. Cannot
/// be judged else; the caller says why.
TimingVerdict judge_slowness(const Slowness& slowness, const TimingTolerance& tolerance);

/// Of a speed-up (time of the reference / time of the detector) that must be at least `limit`.
/// A speed-up of 0 is slowness without end.
results::Ratio slowness_of(const results::Ratio& speedup, double limit);

/// Of a ratio that may be at most `limit`: a speed-up, or a slow-down (speed-up before / speed-up
/// now, over the same reference).
results::Ratio over_limit(const results::Ratio& ratio, double limit);

/// Why times of one run say nothing about those of the other: another CPU, number of cores,
/// instruction set, compiler, build, or version of a library. Empty when they do.
std::string other_machine(const results::Results& now, const results::Results& before);

/// Verdict, what was measured and why. `before`: the baseline, or null.
/// @pre not null where needs_baseline(rule); the rule is a timing rule; the row's status is `ok`
Check judge_timing(const Rule& rule, const results::Index& now, const results::Index* before,
                   const results::Run& row);

}  // namespace contactcheck::gate
