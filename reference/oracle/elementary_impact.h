// The ground truth of moving elements: whether a vertex and a triangle, or two edges, meet between
// frames.
//
// Shares nothing with core/narrow/impact.h but the types: integers of any length, polynomials in t,
// barycentric coordinates instead of projections, roots isolated by Descartes' rule, and zeros at
// roots found by greatest common divisors. (core projects, and counts signs by Cauchy indices.)
#pragma once

#include <gmpxx.h>

#include <array>

#include "core/types/impact.h"

namespace contactcheck::oracle {

/// An ImpactQuery whose coordinates are rationals, as files of queries have them.
struct RationalImpactQuery {
  ImpactKind kind = ImpactKind::vertex_triangle;
  std::array<std::array<mpq_class, 3>, 4> start, end;
};

/// Exact, for all rationals.
Impact elementary_impact(const RationalImpactQuery& query);

/// Exact, for all finite doubles. @pre finite coordinates
Impact elementary_impact(const ImpactQuery& query);

}  // namespace contactcheck::oracle
