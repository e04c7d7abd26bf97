// Contact episodes: when two bodies begin to touch, in truth and by report.
#pragma once

#include <functional>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::judge {

/// Per frame, canonical sets of body pairs.
using BodyPairsPerFrame = std::vector<std::vector<BodyPair>>;

/// An episode is a longest run of frames in which a pair is in true or in reported contact.
/// late_frames is set where the run has both; hover_gap is left to the caller.
std::vector<results::Episode> find_episodes(const BodyPairsPerFrame& truth,
                                            const BodyPairsPerFrame& reported);

/// Sets what a scene's episodes come to: hover_gap_max, of the gaps that are known, and
/// late_frames.
void sum_up_episodes(results::Geometry& geometry);

/// The true distance at the moment a detector first reports contact, by bisecting time.
/// `reports(t)`: does it report the pair at t; `distance(t)`: true distance, metres. Halves
/// [before, after] until the distance at both ends differs by less than `tolerance`.
/// @pre !reports(before) && reports(after)
double bisect_hover_gap(double before, double after, double tolerance,
                        const std::function<bool(double)>& reports,
                        const std::function<double(double)>& distance);

}  // namespace contactcheck::judge
