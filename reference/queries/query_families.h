// Hard families of elementary queries: one parameter each, over a range in which methods begin to
// fail.
//
// Queries are made from the family and the value alone, by numbers of SplitMix64 and basic
// arithmetic, so they are the same on every machine. Their truth is the oracle's.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/types/impact.h"

namespace contactcheck::queries {

struct QueryFamily {
  std::string id, title;
  std::string parameter;  ///< what the values are, with the unit
  std::vector<double> values;
  ImpactKind kind;
  /// Queries of one value; more than one where places and directions are drawn.
  std::function<std::vector<ImpactQuery>(double value)> queries;
};

/// All families, in the order in which they are shown.
const std::vector<QueryFamily>& query_families();

}  // namespace contactcheck::queries
