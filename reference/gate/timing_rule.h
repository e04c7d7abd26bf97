// Rules about ratios of times, and whether the times of two runs can be compared.
#pragma once

#include <cstddef>
#include <string>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"
#include "reference/results/statistics.h"

namespace contactcheck::gate {

// Whether a ratio of times exceeds its limit; takes plain numbers, so that simulations can test it.

/// A detector's time divided by the longest time that its limit allows: above 1 it is too slow. For
/// the upper limit of a speed-up, the reference takes the detector's place.
struct Slowness {
  results::Ratio ratio;
  double frame_us = 0.0;   ///< the time per frame of the one that may be too slow
  std::size_t passes = 0;  ///< measurements of the ratio; they decide its ends (interval_name)
};

/// The tolerances of the rule, as in a policy.
struct TimingTolerance {
  double floor_us = 0.0, noise_width = 0.0;
};

struct TimingVerdict {
  Verdict verdict = Verdict::kPass;
  double excess_us = 0.0;  ///< per frame above the allowed time; at least 0
  std::string reason;      ///< empty if it is fast enough or cannot be judged
};

/// With an interval: fails if all of it is above 1 and the excess per frame reaches the floor. Too
/// noisy if it contains 1 and is wider than the noise width, since failing would be a matter of
/// luck. Passes otherwise. With a range: fails if all of it is above kRangeFactor and the excess
/// reaches the floor, passes if all of it is below 1 / kRangeFactor or the frame is shorter than
/// the floor. Otherwise it cannot be judged; the caller says why.
TimingVerdict judge_slowness(const Slowness& slowness, const TimingTolerance& tolerance);

/// The slowness for a speed-up (time of the reference / time of the detector) that must be at least
/// `limit`; infinite for a speed-up of 0.
results::Ratio slowness_of(const results::Ratio& speedup, double limit);

/// The slowness for a ratio that may be at most `limit`: a speed-up, or a slow-down (speed-up
/// before / speed-up now, over the same reference).
results::Ratio over_limit(const results::Ratio& ratio, double limit);

/// Why the times of two runs cannot be compared: another CPU, number of cores, instruction set,
/// compiler, build, or version of a library. Empty if they can.
std::string other_machine(const results::Results& now, const results::Results& before);

/// Verdict, what was measured and why. `before`: the baseline, or null.
/// @pre not null where needs_baseline(rule); the rule is a timing rule; the row's status is `ok`
Check judge_timing(const Rule& rule, const results::Index& now, const results::Index* before,
                   const results::Run& row);

}  // namespace contactcheck::gate
