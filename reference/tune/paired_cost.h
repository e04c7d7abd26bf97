// The cost of a detector relative to another, from times that a busy machine has partly spoiled.
//
// A pair is one frame of one and of the other in passes that ran one after the other (of a step:
// in repeats). A machine that slows down slows both, so that their quotient stays; one of the two
// that is preempted makes one quotient too high or too low, and the median over the pairs of a
// frame passes over those on either side alike.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "reference/timing/speedup.h"

namespace contactcheck::tune {

/// Nanoseconds of one frame, by pass; as many of one as of the other.
struct PairedFrame {
  std::vector<double> own, anchor;
};

/// By frame, of one run.
using PairedRun = std::map<std::size_t, PairedFrame>;

/// Pairs two playbacks, frame by frame: pass p of one with pass p of the other, while both have
/// one. The first frame counts only if there is no other.
PairedRun pair_up(const timing::QuestionSamples& own, const timing::QuestionSamples& anchor);

/// How many times the anchor it costs: the mean over frames of the median quotient, weighted by
/// what the anchor takes for the frame (the least of its passes: a preemption only adds). Runs are
/// pooled over the frames that all of them have. The interval is a bootstrap over runs and the
/// pairs of each frame; fewer than 3 pairs of a frame show no spread, and then frames are drawn
/// too, which is wider. Of one pair in all the interval is open: 0 to infinity. Frames are drawn
/// apart, so what all frames of a pass have in common widens it only through further runs.
/// @pre at least one run; all share a frame; times are finite and above 0
results::Ratio relative_cost(const std::vector<PairedRun>& runs);

}  // namespace contactcheck::tune
