// The affine map that carries a lattice from rest to where it is now, as nearly as one affine map
// can, and the residual displacements. Bounds that follow the map pay for residuals only: a body in
// rigid motion has none.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// Which map is fitted. Every one is sound: it decides how tight the bounds are.
enum class ReferenceKind {
  kAffine,  ///< least squares over the nodes
  kRigid,   ///< the least-squares rotation and translation
  kNone     ///< a translation: displacements are counted from where the body was at rest
};

/// T(x) = linear * (x - origin) + offset. Its doubles are its definition.
struct AffineMap {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  Vec3 origin = Vec3::Zero();  ///< metres, at rest
  Vec3 offset = Vec3::Zero();  ///< metres, now
};

/// Not below the spectral norm of the matrix, and above it by 0.3 % at most (and 2^-500, so that
/// products with it do not underflow); infinite where it overflows.
/// Proof, with s the spectral norm of X = X_0, scaled by a power of two so that its largest entry
/// lies in [1/2, 1):
///   * s lies in [1/2, 3], so s^256 is far from both ends of the doubles.
///   * X_(i+1) = X_i^T X_i squares the spectral norm. In floating point every entry errs by at most
///     g (|X|^T |X|) with g < 3.01 * 2^-53, so the norm by g |X|_F^2 <= 3 g s^2.
///   * So at least s^2 (1 - h) is left after a squaring, h = 3 g < 10 * 2^-53.
///   * k squarings and k square roots of |X_k|_F >= s(X_k) give at least
///     s (1 - h)^(1/2 + 1/4 + ...) > s (1 - h).
///   * They give at most 3^(1 / 2^(k + 1)) s, up to rounding, as |X_k|_F <= sqrt(3) s(X_k). That is
///     1.0022 s for k = 8.
///   * A root errs by 2^-53 and halves the error of what came before. A factor of 1 + 32 * 2^-53
///     pays for all roundings.
/// @pre no NaN
double spectral_norm_bound(const Eigen::Matrix3d& matrix);

/// Fits maps to the nodes of one lattice; made once per shape.
class ReferenceFit {
 public:
  ReferenceFit() = default;
  /// @pre finite nodes, at least one
  explicit ReferenceFit(std::vector<Vec3> rest);

  /// The map of the kind asked for; the zero map (linear and offset 0) where that could overflow:
  /// T(rest node) and its difference from the node are always finite.
  /// `origin`: what was subtracted from the nodes and not from the rest (local_origin.h); kNone
  /// subtracts it, too; the other kinds fit it.
  /// @pre `nodes`: one per rest node, finite
  AffineMap fit(ReferenceKind kind, std::span<const Vec3> nodes,
                const Vec3& origin = Vec3::Zero()) const;

  /// Not below the largest |coordinate| of any intermediate value of T(rest node).
  double largest_value(const AffineMap& map) const;
  const std::vector<Vec3>& rest() const { return rest_; }

 private:
  Eigen::Matrix3d fitted_linear(ReferenceKind kind, std::span<const Vec3> nodes,
                                const Vec3& center) const;

  std::vector<Vec3> rest_;
  Vec3 center_ = Vec3::Zero();                                // of the rest nodes
  Vec3 reach_ = Vec3::Zero();                                 // largest |rest - center_|, per axis
  Eigen::Matrix3d inverse_moment_ = Eigen::Matrix3d::Zero();  // of sum (r - c)(r - c)^T
};

}  // namespace contactcheck
