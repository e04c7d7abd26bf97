#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace contactcheck {

/// A point or vector; metres. T: double, or float about a local origin (local_origin.h).
template <typename T>
using Vec3Of = Eigen::Matrix<T, 3, 1>;
using Vec3 = Vec3Of<double>;
using Vec3f = Vec3Of<float>;

/// Closed axis-aligned box; empty while lo > hi.
template <typename T>
struct AabbOf {
  using Point = Vec3Of<T>;
  Point lo = Point::Constant(std::numeric_limits<T>::infinity());
  Point hi = Point::Constant(-std::numeric_limits<T>::infinity());

  void extend(const Point& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void extend(const AabbOf& other) {
    lo = lo.cwiseMin(other.lo);
    hi = hi.cwiseMax(other.hi);
  }
  /// Closed: boxes that share only a boundary point overlap.
  bool overlaps(const AabbOf& other) const {
    return lo.x() <= other.hi.x() && other.lo.x() <= hi.x() && lo.y() <= other.hi.y() &&
           other.lo.y() <= hi.y() && lo.z() <= other.hi.z() && other.lo.z() <= hi.z();
  }
  bool contains(const Point& p) const {
    return (lo.array() <= p.array()).all() && (p.array() <= hi.array()).all();
  }
  bool contains(const AabbOf& other) const { return contains(other.lo) && contains(other.hi); }
  bool empty() const { return !(lo.array() <= hi.array()).all(); }
  Point center() const { return T(0.5) * lo + T(0.5) * hi; }
  Point extent() const { return hi - lo; }
};
using Aabb = AabbOf<double>;

}  // namespace contactcheck
