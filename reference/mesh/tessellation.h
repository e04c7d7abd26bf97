// Fewer or more triangles on the same surface.
#pragma once

#include <cstddef>

#include "core/types/mesh.h"

namespace contactcheck::mesh {

/// At most `triangles` triangles (edge collapses stop at or just below the wish, or above it where
/// the surface's topology allows no more). Kept vertices keep their doubles: meshoptimizer picks
/// among the given vertices, and floats serve its error measure alone. Vertices without a triangle
/// are dropped; the order of the rest is kept. Deterministic.
///
/// Where copies of a vertex, such as those of texture seams, keep it above the wish, vertices with
/// equal coordinates are one: the result has fewer triangles then, and no copies.
///
/// meshoptimizer 0.18 may fold thin parts together into a non-manifold edge. For a solid mesh, when
/// a direct simplification does so, a few that stop at a larger count in between are tried, and the
/// first solid result of the same size is taken; without one, the direct result stands.
/// @pre no fatal defect; triangles >= 1. A mesh with no more than `triangles` is returned as it is.
TriangleMesh simplify(const TriangleMesh& mesh, std::size_t triangles);

/// Splits every triangle into four at the midpoints of its edges, `times` over. Triangles that
/// share an edge share its midpoint; given vertices come first and keep their doubles. The surface
/// stays where it was, up to the rounding of midpoints.
TriangleMesh subdivide(TriangleMesh mesh, std::size_t times);

}  // namespace contactcheck::mesh
