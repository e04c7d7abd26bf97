// The order of timing, drawn by seed: equal on every machine for the same seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace contactcheck::timing {

/// The frames of a scene that are timed cold, the same for all detectors: 8, or all if there are
/// fewer; ascending. If some frames have contact, at least one of them is included.
std::vector<std::size_t> draw_cold_frames(const std::vector<bool>& contact_frames,
                                          std::uint64_t seed);

/// The numbers below `count` in an order that the seed decides.
std::vector<std::size_t> draw_order(std::size_t count, std::uint64_t seed);

}  // namespace contactcheck::timing
