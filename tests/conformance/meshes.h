// Meshes whose coordinates are short binary fractions, and bodies of them that keep these exact.
#pragma once

#include <string>

#include "core/deform/body.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// Half the side of the cube that every mesh below fills, metres.
inline constexpr double kHalfSide = 1.0;

/// The octahedron |x| + |y| + |z| = 1.
TriangleMesh octahedron_mesh();
/// A regular tetrahedron on corners of [-1, 1]^3: its top edge (z = 1) and its bottom edge cross at
/// a right angle when seen along z.
TriangleMesh tetrahedron_mesh();
/// [-1, 1]^3, every face divided into n x n quads.
TriangleMesh cube_mesh(int n);

/// The octahedron, a segment from (0.5, 0.5, 0.5) to (1, 0.5, 0.5) and a point at
/// (0.875, 0.75, 0.75) written as triangles, and a triangle that names a vertex twice.
TriangleMesh mesh_with_degenerate_triangles();
/// The octahedron and a vertex (1, 1, 1) that no triangle names, and that is dropped.
TriangleMesh mesh_with_isolated_vertex();
/// The cube without its face x = 1, and a triangle without area on the rim.
TriangleMesh open_mesh();
/// Two octahedra of radius 1/2 about (-0.5, -0.5, -0.5) and (0.5, 0.5, 0.5).
TriangleMesh mesh_of_two_components();

TriangleMesh scaled(TriangleMesh mesh, double factor);

/// In a lattice of 4 x 4 x 4 cells, twice as wide as the mesh: grid lines and local coordinates are
/// short binary fractions, so a body moved by such maps without rounding.
/// @pre the mesh fills a cube about the origin whose side is a power of two
Body exact_body(const std::string& name, TriangleMesh mesh);

}  // namespace contactcheck::test
