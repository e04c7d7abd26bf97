// Built-in shapes: closed, edge-manifold, consistently oriented triangle meshes, centred on the
// origin. Only additions, products, quotients and square roots: the same bits on every machine.
#pragma once

#include <cstddef>

#include "core/types/mesh.h"

namespace contactcheck {

/// A box with the given sides (metres, above 0); every face is a grid of divisions x divisions
/// squares: 12 * divisions^2 triangles.
TriangleMesh make_box(const Vec3& sides, std::size_t divisions);

/// A sphere of diameter 1: an icosahedron, each triangle split in four `divisions` times and its
/// vertices pushed to the sphere: 20 * 4^divisions triangles.
TriangleMesh make_sphere(std::size_t divisions);

/// A torus about the z axis with outer diameter 1. `tube` is the tube's radius as a fraction of the
/// ring's, in (0, 1). 2 * divisions segments round the ring, `divisions` round the tube:
/// 4 * divisions^2 triangles. @pre divisions >= 3
TriangleMesh make_torus(double tube, std::size_t divisions);

}  // namespace contactcheck
