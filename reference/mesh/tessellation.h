// Simplifies or subdivides a mesh.
#pragma once

#include <cstddef>

#include "core/types/mesh.h"

namespace contactcheck::mesh {

/// Simplifies to at most `triangles` triangles (just below it, or above it if the surface's
/// topology allows no more edge collapses). Kept vertices keep their doubles: meshoptimizer selects
/// among the given vertices, and floats are used only for its error measure. Vertices without a
/// triangle are dropped; the order of the rest is kept. Deterministic.
///
/// If copies of a vertex, such as those of texture seams, keep the count above `triangles`,
/// vertices with equal coordinates become one; the result then has fewer triangles and no copies.
///
/// meshoptimizer 0.18 may fold thin parts together into a non-manifold edge. If that happens to a
/// solid mesh, simplifications in two steps are tried, and the first solid result of the same size
/// is returned; without one, the direct result.
/// @pre no fatal defect; triangles >= 1. A mesh with no more than `triangles` is returned as it is.
TriangleMesh simplify(const TriangleMesh& mesh, std::size_t triangles);

/// Splits every triangle into four at the midpoints of its edges, `times` times. Triangles that
/// share an edge share its midpoint; given vertices come first and keep their doubles. The surface
/// does not change, up to the rounding of midpoints.
TriangleMesh subdivide(TriangleMesh mesh, std::size_t times);

}  // namespace contactcheck::mesh
