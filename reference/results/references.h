// The reference libraries, which speed-ups are measured against.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace contactcheck::results {

/// Their detectors, in the order of tables. Each has a column; a run gives speed-ups against those
/// that it contains.
inline constexpr std::array kReferences = {"fcl-aabb", "fcl-obbrss", "embree"};
/// Those of contact between frames.
inline constexpr std::array kStepReferences = {"fcl-ccd", "embree-swept"};

/// True for these, and for variants of the first with prefilter=nodes, which have no column but are
/// references in tables by scene.
inline bool is_reference(std::string_view detector) {
  constexpr std::string_view kPrefilter = ":prefilter=nodes";
  if (detector.ends_with(kPrefilter)) detector.remove_suffix(kPrefilter.size());
  return std::ranges::find(kReferences, detector) != kReferences.end() ||
         std::ranges::find(kStepReferences, detector) != kStepReferences.end();
}

}  // namespace contactcheck::results
