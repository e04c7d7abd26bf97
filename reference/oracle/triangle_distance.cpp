// The closest points of two disjoint triangles lie on a corner and a face, or on two edges
// (Ericson, Real-Time Collision Detection, 2005, 5.1). Each candidate here is a pair of points of
// the two triangles, however rounded its parameters: its distance bounds the true one from above.
// From below: for any direction, the gap between the triangles' extents along it.
//
// Rounding, with e = 2^-53 and |coordinates| <= 1. A computed point a + (b - a) s + (c - a) t is
// off by less than 17 e per coordinate (2e per difference, 2e more per product, 3e and 4e for the
// sums, and s + t may exceed 1 by e), so by 30 e in length; the distance of two such points by 60
// e, plus 4 e for the differences and 7 e * 3.5 for the square root of the sum of squares: below
// 100 e. A slab: each dot product with a unit vector (off by 4 e) is within 12 e, their difference
// within 30 e, and the length of the vector, above 1 by less than 8 e, changes a gap of at most 3.5
// by 28 e: below 100 e. Underflow adds less than 2^-1000.
#include "reference/oracle/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactcheck::oracle {
namespace {

// Bounds the rounding of a distance or gap, more than twofold; part of every interval's width.
constexpr double kRounding = 256 * 0x1p-53;

// Below, the squares of a vector would underflow and its direction be lost.
constexpr double kShortestDirection = 0x1p-400;

struct ClosestPoints {
  Vec3 on_p, on_q;
  Vec3 normal = Vec3::Zero();  // of two edges, where these are nearest; else zero
  double squared = std::numeric_limits<double>::infinity();

  bool offer(const Vec3& p, const Vec3& q) {
    const double d = (p - q).squaredNorm();
    if (!(d < squared)) return false;
    on_p = p;
    on_q = q;
    normal.setZero();
    squared = d;
    return true;
  }
};

double clamp_to_unit(double s) { return s > 0 ? std::min(s, 1.0) : 0.0; }

// The point of the segment a b nearest to p, up to rounding.
Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  if (!(length2 > 0)) return a;
  return a + d * clamp_to_unit(d.dot(p - a) / length2);
}

// If p projects into the face, that point; false otherwise (an edge is nearer, or it is
// degenerate).
bool nearest_in_face(const Vec3& p, const TriangleCorners& t, Vec3& out) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const double det = uu * vv - uv * uv;
  if (!(det > 0)) return false;
  const double wu = w.dot(u), wv = w.dot(v);
  const double s = (wu * vv - wv * uv) / det, r = (wv * uu - wu * uv) / det;
  if (!(s >= 0 && r >= 0 && s + r <= 1)) return false;
  out = t[0] + u * s + v * r;
  return true;
}

// The nearest points of two segments where both are inner points.
void offer_inner_points(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                        ClosestPoints& best) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const double det = uu * vv - uv * uv;
  if (!(det > 0)) return;
  const double wu = w.dot(u), wv = w.dot(v);
  const double s = (uv * wv - vv * wu) / det, r = (uu * wv - uv * wu) / det;
  if (!(s >= 0 && s <= 1 && r >= 0 && r <= 1)) return;
  if (best.offer(a + u * s, c + v * r)) best.normal = u.cross(v);
}

Vec3 normal_of(const TriangleCorners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

void offer_corners(const TriangleCorners& p, const TriangleCorners& q, bool swapped,
                   ClosestPoints& best) {
  const auto offer = [&](const Vec3& x, const Vec3& y) {
    return swapped ? best.offer(y, x) : best.offer(x, y);
  };
  for (const Vec3& corner : p) {
    for (int k = 0; k < 3; ++k) offer(corner, nearest_on_segment(corner, q[k], q[(k + 1) % 3]));
    Vec3 in_face;
    if (nearest_in_face(corner, q, in_face)) offer(corner, in_face);
  }
}

ClosestPoints closest_points(const TriangleCorners& p, const TriangleCorners& q) {
  ClosestPoints best;
  offer_corners(p, q, false, best);
  offer_corners(q, p, true, best);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      offer_inner_points(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3], best);
  return best;
}

// The gap between the two along a direction of any length, in either sense.
double gap_along(const Vec3& direction, const TriangleCorners& p, const TriangleCorners& q) {
  const double length = direction.norm();
  if (!(length > kShortestDirection)) return 0.0;
  const Vec3 unit = direction / length;
  const auto [p_low, p_high] = std::minmax({unit.dot(p[0]), unit.dot(p[1]), unit.dot(p[2])});
  const auto [q_low, q_high] = std::minmax({unit.dot(q[0]), unit.dot(q[1]), unit.dot(q[2])});
  return std::max(p_low - q_high, q_low - p_high);
}

}  // namespace

double slab_bound(const TriangleCorners& p, const TriangleCorners& q) {
  return std::max(
      {0.0, gap_along(normal_of(p), p, q) - kRounding, gap_along(normal_of(q), p, q) - kRounding});
}

DistanceBounds distance_bounds(const TriangleCorners& p, const TriangleCorners& q) {
  const ClosestPoints best = closest_points(p, q);
  const double distance = std::sqrt(best.squared);
  double gap = gap_along(best.on_p - best.on_q, p, q);
  // The direction between points that nearly touch is mostly rounding: the normals of edges and
  // faces do not suffer from that.
  if (gap < distance - kRounding) gap = std::max(gap, gap_along(best.normal, p, q));
  if (gap < distance - kRounding) {
    gap = std::max({gap, gap_along(normal_of(p), p, q), gap_along(normal_of(q), p, q)});
  }
  return {std::max(0.0, gap - kRounding), distance + kRounding};
}

DistanceBounds unscaled(const DistanceBounds& bounds, int exponent) {
  if (bounds.upper == 0) return {};
  const double lower = bounds.lower < 0x1p-1000 ? 0.0 : bounds.lower;
  const double largest = std::numeric_limits<double>::max();
  DistanceBounds out{std::ldexp(lower, exponent), std::ldexp(bounds.upper, exponent)};
  if (out.lower < 0x1p-1020) out.lower = std::nextafter(out.lower, 0.0);
  if (out.upper < 0x1p-1020) out.upper = std::nextafter(out.upper, largest);
  out.lower = std::min(out.lower, largest);
  return out;
}

}  // namespace contactcheck::oracle
