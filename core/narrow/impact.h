// Exact tests of moving elements: whether a vertex and a triangle, or two edges, meet between
// frames.
#pragma once

#include "core/types/impact.h"

namespace contactcheck {

/// Exact for all finite doubles: filters with proven error bounds answer first (impact_filter.h),
/// else exact integers do.
/// @pre finite coordinates; the processor rounds to nearest and does not flush denormals to zero
Impact find_impact(const ImpactQuery& query);

/// The same for whoever looks for the first of many contacts: a time that is certainly after
/// `until` need not be certified, and its interval may be wider than kImpactTimeWidth.
Impact find_impact(const ImpactQuery& query, double until);

/// The exact path alone, without a filter: slow.
/// @pre finite coordinates
Impact find_impact_exact(const ImpactQuery& query);

}  // namespace contactcheck
