// Which frames are timed when a detector is too slow for all of them.
#pragma once

#include <cstddef>
#include <vector>

namespace contactcheck {

/// All frames in an order whose every prefix is spread over the scene and holds contact frames in
/// about their share of the whole (the first one a contact frame, if there is any). Detectors are
/// timed on prefixes, so that any two share the frames of the shorter.
std::vector<std::size_t> timing_order(const std::vector<bool>& contact_frames);

/// How many frames fit: budget / (cost per repeat * repeats), within [fewest, frames]; half of the
/// fewest where these would take ten times the budget.
std::size_t frames_within_budget(double budget_seconds, double seconds_per_repeat,
                                 std::size_t repeats, std::size_t fewest, std::size_t frames);

}  // namespace contactcheck
