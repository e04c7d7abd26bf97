// Contact episodes: when two bodies begin to touch, in truth and by report.
#pragma once

#include <functional>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::judge {

/// One canonical set of body pairs per frame.
using BodyPairsPerFrame = std::vector<std::vector<BodyPair>>;

/// An episode is a longest run of frames in which a pair is in true or in reported contact. Sets
/// late_frames if the run has both; hover_gap is the caller's to set.
std::vector<results::Episode> find_episodes(const BodyPairsPerFrame& truth,
                                            const BodyPairsPerFrame& reported);

/// Sets the scene's sums: hover_gap_max over the gaps that were measured, and late_frames, the
/// largest by absolute value.
void sum_up_episodes(results::Geometry& geometry);

/// The true distance, metres, when the detector first reports contact, by bisecting time.
/// `reports(t)`: the detector reports the pair at t; `distance(t)`: true distance, metres. Halves
/// [before, after] until the distances at its ends differ by less than `tolerance`.
/// @pre !reports(before) && reports(after)
double bisect_hover_gap(double before, double after, double tolerance,
                        const std::function<bool(double)>& reports,
                        const std::function<double(double)>& distance);

}  // namespace contactcheck::judge
