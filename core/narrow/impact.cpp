#include "core/narrow/impact.h"

#include <limits>

#include "core/narrow/impact_filter.h"
#include "core/narrow/triangle_triangle.h"

namespace contactcheck {
namespace {

/// Degenerate triangles are the segments and points that they are, so this tests elements as well.
bool meet_at_start(const ImpactQuery& query) {
  const auto& [p, q, r, s] = query.start;
  return query.kind == ImpactKind::vertex_triangle
             ? triangles_intersect(TrianglePoints{p, p, p}, TrianglePoints{q, r, s})
             : triangles_intersect(TrianglePoints{p, q, q}, TrianglePoints{r, s, s});
}

}  // namespace

Impact find_impact(const ImpactQuery& query) {
  return find_impact(query, std::numeric_limits<double>::infinity());
}

Impact find_impact(const ImpactQuery& query, double until) {
  const FilteredImpact filtered = filter_impact(query, until);
  if (filtered.verdict == FilterVerdict::apart) return {};
  if (filtered.verdict == FilterVerdict::contact)
    return {true, false, filtered.earliest, filtered.latest};
  // Most of what filters cannot decide begins in contact, which costs a fraction of the exact path.
  if (meet_at_start(query)) return {true, true, 0, 0};
  return find_impact_exact(query);
}

}  // namespace contactcheck
