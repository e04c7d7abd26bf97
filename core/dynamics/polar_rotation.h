// The rotation nearest to a 3x3 matrix, by additions, products, quotients and square roots alone.
// Sources: Higham, Computing the Polar Decomposition with Applications, 1986 (scaled Newton
// iteration); Horn, Closed-form Solution of Absolute Orientation Using Unit Quaternions, 1987 (the
// rotation as an eigenvector, here by Jacobi's cyclic method).
#pragma once

#include "core/dynamics/fixed_order.h"

namespace contactcheck {

struct PolarRotation {
  Mat3 rotation = Mat3::Identity();  ///< orthonormal up to rounding, determinant +1
  bool converged = true;             ///< false: NaN or infinity came in; rotation is the identity
};

/// The R that maximises tr(R^T m), of all rotations: the polar factor where det m > 0. For a flat
/// or an inverted m it is still the best proper rotation, and continuous in m wherever the best is
/// unique. Where several are equally good (m of rank one, a perfect mirror image) it is one of
/// them, always the same for the same bits; for the zero matrix it is the identity. Depends on m
/// alone, no previous rotation: what it gives does not depend on how a state was reached.
PolarRotation polar_rotation(const Mat3& m);

}  // namespace contactcheck
