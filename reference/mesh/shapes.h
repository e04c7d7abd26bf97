// Built-in shapes: consistently oriented triangle meshes, closed and edge-manifold except sheet and
// teapot. Only sums, products, quotients and square roots: the same bits on every machine.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types/mesh.h"

#include "reference/mesh/datasets.h"

namespace contactcheck::mesh {

// Extruded letters, some with holes, some concave: the bodies of the paper's alphabet scene.

/// All available letters: "ABCDEHILOPRTU".
const std::string& known_letters();

/// A letter in the xy plane, extruded along z to `depth` (above 0): closed, edge-manifold,
/// consistently oriented. Glyphs are 5 x 7 pixels, bent into shape, in a field of 5/7 x 1 round the
/// origin; each pixel is divisions x divisions squares of two triangles. With 4 divisions and depth
/// 0.2 an O has 3,200 triangles.
/// @pre `letter` is one of known_letters(), divisions >= 1
TriangleMesh make_letter(char letter, double depth, std::size_t divisions);

// The Utah teapot, from the 32 bicubic Bezier patches that Debian's povray-examples ships.

/// Points closer than this, in each coordinate, become one vertex; in the unit of the patches, in
/// which the teapot is 6.4 long. Any value from 1e-9 to 1e-4 gives the same mesh; at 0, patches
/// that meet with different rounding stay open (3,277 vertices instead of 3,241).
inline constexpr double kTeapotWeld = 1e-6;

/// divisions x divisions squares of two triangles per patch, z up, in the unit of the patches. With
/// 10 divisions: 3,241 vertices and 6,400 triangles, the paper's teapot. 80 triangles have no area
/// (patches that end in a point) and 160 edges lie on a boundary, so it is not a solid. `seams`:
/// patches share no vertex; those that meet have bit-identical vertices there.
/// @pre divisions >= 1
/// @throws InputError when povray-examples is missing or does not hold 32 patches
TriangleMesh make_teapot(std::size_t divisions,
                         const std::vector<std::filesystem::path>& roots = data_roots(),
                         bool seams = false);

// Points on the unit circle without libm, so that built-in shapes have the same bits everywhere:
// glibc's sin and cos differ between processors with and without fused multiply-add.

struct CirclePoint {
  double cosine = 1.0, sine = 0.0;
};

/// The point at `k` of `n` equal steps round the circle, within 2^-51 of the exact one; exact at
/// the quarters, and symmetric about both axes and both diagonals.
/// @pre n > 0
CirclePoint circle_point(std::size_t k, std::size_t n);

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

/// An open, flat sheet in the xz plane, 1 m along x and `length` along z, its normals along y:
/// divisions x divisions squares of two triangles. @pre divisions >= 1, length > 0
TriangleMesh make_sheet(double length, std::size_t divisions);

}  // namespace contactcheck::mesh
