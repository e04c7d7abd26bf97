// What is timed when: drawn by seed, the same for the same seed on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace contactcheck::timing {

/// The frames of a scene that are timed cold, the same for all detectors: 8, or all where there are
/// no more; ascending. Where some frames have contact, so has one of these.
std::vector<std::size_t> draw_cold_frames(const std::vector<bool>& contact_frames,
                                          std::uint64_t seed);

/// The numbers below `count` in an order that the seed decides.
std::vector<std::size_t> draw_order(std::size_t count, std::uint64_t seed);

}  // namespace contactcheck::timing
