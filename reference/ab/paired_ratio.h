// The ratio of two times that were measured side by side, round by round.
#pragma once

#include <vector>

#include "reference/diff/ratio_interval.h"

namespace contactcheck {

/// The median over rounds of head / base, with a percentile bootstrap 95 % interval (2000 draws of
/// rounds with replacement, fixed seed). The two times of a round ran one after the other: what
/// slows the machine for a while slows both, and one slow round moves the median little.
/// @pre as many of both, at least one; all above 0
RatioInterval paired_ratio(const std::vector<double>& base, const std::vector<double>& head);

}  // namespace contactcheck
