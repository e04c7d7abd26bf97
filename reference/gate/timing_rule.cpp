#include "reference/gate/timing_rule.h"

#include <fmt/format.h>

namespace contactcheck {
namespace {

TimingVerdict beyond(const Slowness& slowness, const TimingTolerance& tolerance) {
  TimingVerdict out;
  out.excess_us = slowness.frame_us * (1.0 - 1.0 / slowness.ratio.value);
  const bool matters = out.excess_us >= tolerance.floor_us;
  out.verdict = matters ? Verdict::kFail : Verdict::kPass;
  out.reason = matters ? fmt::format("{:.3g} us too long per frame of {:.4g} us", out.excess_us,
                                     slowness.frame_us)
                       : fmt::format("beyond the limit by {:.3g} us per frame, less than {:.3g} us",
                                     out.excess_us, tolerance.floor_us);
  return out;
}

TimingVerdict of_range(const Slowness& slowness, const TimingTolerance& tolerance) {
  if (slowness.ratio.low > kRangeFactor) return beyond(slowness, tolerance);
  TimingVerdict out;
  // Of a frame that is shorter than the floor no excess can reach it.
  if (slowness.frame_us < tolerance.floor_us) return out;
  if (slowness.ratio.high >= 1.0 / kRangeFactor) out.verdict = Verdict::kCannotJudge;
  return out;
}

}  // namespace

TimingVerdict judge_slowness(const Slowness& slowness, const TimingTolerance& tolerance) {
  const Ratio& r = slowness.ratio;
  if (slowness.passes < kFewestForInterval) return of_range(slowness, tolerance);
  if (r.low > 1.0) return beyond(slowness, tolerance);
  const bool wide = r.high > r.low * (1.0 + tolerance.noise_width);
  if (r.high <= 1.0 || !wide) return {};
  TimingVerdict out;
  out.verdict = Verdict::kTooNoisy;
  out.reason = fmt::format("the limit lies inside the 95 % interval, whose ends are {:.3g}x apart",
                           r.high / r.low);
  return out;
}

Ratio slowness_of(const Ratio& speedup, double limit) {
  return {limit / speedup.value, limit / speedup.high, limit / speedup.low};
}

Ratio over_limit(const Ratio& slowdown, double limit) {
  return {slowdown.value / limit, slowdown.low / limit, slowdown.high / limit};
}

}  // namespace contactcheck
