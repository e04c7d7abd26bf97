#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace contactcheck {

/// A point or vector; metres, IEEE double.
using Vec3 = Eigen::Vector3d;

/// Closed axis-aligned box; empty while lo > hi.
struct Aabb {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void extend(const Aabb& other) {
    lo = lo.cwiseMin(other.lo);
    hi = hi.cwiseMax(other.hi);
  }
  /// Closed: boxes that share only a boundary point overlap.
  bool overlaps(const Aabb& other) const {
    return lo.x() <= other.hi.x() && other.lo.x() <= hi.x() && lo.y() <= other.hi.y() &&
           other.lo.y() <= hi.y() && lo.z() <= other.hi.z() && other.lo.z() <= hi.z();
  }
  bool contains(const Vec3& p) const {
    return (lo.array() <= p.array()).all() && (p.array() <= hi.array()).all();
  }
  bool contains(const Aabb& other) const { return contains(other.lo) && contains(other.hi); }
  bool empty() const { return !(lo.array() <= hi.array()).all(); }
  Vec3 center() const { return 0.5 * lo + 0.5 * hi; }
  Vec3 extent() const { return hi - lo; }
};

}  // namespace contactcheck
