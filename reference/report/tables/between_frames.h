// Contact within the steps from frame to frame: what discrete detectors let through.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// The path of the chart's picture next to report.md. No picture of a family has that name.
inline constexpr const char* kTunnellingFile = "plots/tunnelling.svg";

/// Steps of all scenes whose largest motion is in one half of a decade.
struct TunnellingPoint {
  double motion = 0.0;  ///< the middle of it, in mean edges
  double share = 0.0;   ///< pairs of bodies that tunnel / that meet and are apart at the start
};

/// Detectors with the same points. One that did not answer in every step is left out.
struct TunnellingLine {
  std::vector<std::string> detectors;
  std::vector<TunnellingPoint> points;  ///< ascending; where bodies meet
};

/// Sorted by the sum of shares, most first. Empty if nothing tunnels.
std::vector<TunnellingLine> tunnelling(const results::Index& index);

}  // namespace contactcheck::report
