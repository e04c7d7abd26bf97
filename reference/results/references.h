// The libraries that everything is measured against.
#pragma once

#include <array>

namespace contactcheck::results {

/// Their detectors, in the order of tables. Each has a column; a run gives speed-ups against these
/// wherever they run.
inline constexpr std::array kReferences = {"fcl-aabb", "fcl-obbrss", "embree"};

}  // namespace contactcheck::results
