// The stiffness of one box-shaped finite element of isotropic linear material.
// Sources: Wilson, Taylor, Doherty, Ghaboussi, Incompatible Displacement Models, 1973; Taylor,
// Beresford, Wilson, A Non-conforming Element for Stress Analysis, 1976.
#pragma once

#include <array>
#include <cstddef>

#include "core/types/vec3.h"

namespace contactcheck {

/// A symmetric matrix over three displacements of each of the 8 corners: entry (i, k) at
/// [24 * i + k], corner c's displacements at 3 c, 3 c + 1, 3 c + 2. N/m.
using HexahedronStiffness = std::array<double, std::size_t{24} * 24>;

/// Trilinear displacements and, to bend without locking, one inner parabola per axis and direction
/// ("incompatible modes"), which no neighbour sees and which are eliminated here. Their correction
/// of 1976 is the identity for a box, so that every uniform strain is exact.
/// @pre sides and Young's modulus above 0, Poisson's ratio in [0, 0.5)
HexahedronStiffness hexahedron_stiffness(const Vec3& sides, double youngs_modulus,
                                         double poisson_ratio);

/// Never below the largest eigenvalue, and at most 2.6 % above it.
double largest_eigenvalue_bound(const HexahedronStiffness& stiffness);

/// Gradient of a corner's trilinear shape function in the middle of the element, 1/m.
Vec3 corner_gradient(int corner, const Vec3& sides);

}  // namespace contactcheck
