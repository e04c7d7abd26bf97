// The filter of find_impact(): what floating-point numbers can decide about moving elements,
// proven.
#pragma once

#include <cstdint>
#include <limits>

#include "core/types/impact.h"

namespace contactcheck {

enum class FilterVerdict : std::uint8_t { apart, contact, undecided };

struct FilteredImpact {
  FilterVerdict verdict = FilterVerdict::undecided;
  /// The interval of the first time of a `contact`, at most kImpactTimeWidth wide unless it lies
  /// after `until`. (Elements in contact at t = 0 are always `undecided`.)
  double earliest = 0, latest = 0;
};

/// Never wrong; `undecided` where the bounds in impact_filter.cpp do not suffice. The interval of a
/// first time that is certainly after `until` may be wider than kImpactTimeWidth.
/// @pre finite coordinates; the processor rounds to nearest and does not flush denormals to zero
FilteredImpact filter_impact(const ImpactQuery& query,
                             double until = std::numeric_limits<double>::infinity());

}  // namespace contactcheck
