#include "core/broad/reference_map.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace contactcheck {
namespace {

constexpr int kSquarings = 8;
constexpr double kUp = 1.0 + 32.0 * 0x1p-53;
constexpr double kTiny = 0x1p-500;

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  // Divided first: the sum of huge coordinates must not overflow.
  for (const Vec3& p : points) sum += p / static_cast<double>(points.size());
  return sum;
}

// The rotation nearest to the cross moment of nodes and rest nodes (Kabsch 1976).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& moment) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

double spectral_norm_bound(const Eigen::Matrix3d& matrix) {
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (largest == 0.0) return kTiny;
  if (std::isinf(largest)) return largest;
  int exponent = 0;
  std::frexp(largest, &exponent);
  Eigen::Matrix3d x = matrix;
  for (double& value : x.reshaped()) value = std::ldexp(value, -exponent);
  for (int i = 0; i < kSquarings; ++i) x = (x.transpose() * x).eval();
  double norm = x.norm();
  for (int i = 0; i < kSquarings; ++i) norm = std::sqrt(norm);
  return std::ldexp(norm * kUp, exponent) + kTiny;
}

ReferenceFit::ReferenceFit(std::vector<Vec3> rest) : rest_(std::move(rest)) {
  center_ = mean_of(rest_);
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const Vec3& r : rest_) {
    const Vec3 arm = r - center_;
    moment += arm * arm.transpose();
    reach_ = reach_.cwiseMax(arm.cwiseAbs());
  }
  // Singular where squares underflow: the inverse is then not finite, and neither are its fits.
  inverse_moment_ = moment.inverse();
}

AffineMap ReferenceFit::fit(ReferenceKind kind, std::span<const Vec3> nodes,
                            const Vec3& origin) const {
  AffineMap map;
  map.origin = center_;
  if (kind == ReferenceKind::kNone) {
    map.linear.setIdentity();
    map.offset = center_ - origin;
  } else {
    map.offset = mean_of(nodes);
    map.linear = fitted_linear(kind, nodes, map.offset);
  }
  double largest = 0.0;
  for (const Vec3& n : nodes) largest = std::max(largest, n.cwiseAbs().maxCoeff());
  if (!std::isfinite(largest_value(map) + largest)) {
    map.linear.setZero();
    map.offset.setZero();
  }
  return map;
}

Eigen::Matrix3d ReferenceFit::fitted_linear(ReferenceKind kind, std::span<const Vec3> nodes,
                                            const Vec3& center) const {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (std::size_t j = 0; j < nodes.size(); ++j)
    moment += (nodes[j] - center) * (rest_[j] - center_).transpose();
  if (kind == ReferenceKind::kAffine || !moment.allFinite()) return moment * inverse_moment_;
  return nearest_rotation(moment);
}

double ReferenceFit::largest_value(const AffineMap& map) const {
  const Vec3 sums = map.linear.cwiseAbs() * reach_ + map.offset.cwiseAbs();
  // Not maxCoeff(): what it makes of a NaN is not specified.
  double largest = 0.0;
  for (double sum : sums) largest = std::isfinite(sum) ? std::max(largest, sum) : HUGE_VAL;
  return largest * kUp;
}

}  // namespace contactcheck
