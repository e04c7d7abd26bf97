// What a detector costs beside another one, from times that a busy machine has spoiled some of.
//
// Both are timed within a moment of each other, frame by frame and repeat by repeat. A machine that
// slows down slows both, so that the quotient of such a pair stays; one of the two that is
// preempted makes one quotient too high or too low, and the median over the pairs of a frame passes
// over those on either side alike.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "reference/compare/speedup.h"

namespace contactcheck {

/// Cold nanoseconds of one frame, by repeat; as many of one as of the other.
struct PairedFrame {
  std::vector<double> own, anchor;
};

/// By frame, of one run.
using PairedRun = std::map<std::size_t, PairedFrame>;

/// The frames that both were timed on in the same process.
PairedRun pair_up(const ProcessSamples& own, const ProcessSamples& anchor);

/// How many times the anchor it costs: the mean over frames of the median quotient, weighted by
/// what the anchor takes for the frame (the least of its repeats: a preemption only adds). Runs are
/// pooled over the frames that all of them have. The interval is a bootstrap over runs and the
/// pairs of each frame; fewer than 3 pairs of a frame show no spread, and then frames are drawn
/// too, which is wider. Of one pair in all the interval is open: 0 to infinity.
/// @pre at least one run; all share a frame; times are finite and above 0
Ratio relative_cost(const std::vector<PairedRun>& runs);

}  // namespace contactcheck
