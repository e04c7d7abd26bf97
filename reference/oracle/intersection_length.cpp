// Two triangles that cross share a piece of the line in which their planes meet. Each triangle
// covers an interval of it, between the two points where its edges pass through the other's plane;
// the piece is what the intervals have in common.
//
// Rounding, with e = 2^-53: a side (n, w), n = u x v, of differences u, v, w of corners, each off
// by e of itself, has six products of three coordinates, each at most m = |u| |v| |w| in the
// largest norm. The products, with the differences' errors, are off by 36 e m in all, their sums by
// 10 e m: below 64 e m. Of an edge with sides s and r of different, certain signs, the point passed
// through has the parameter s / (s - r), off by at most twice the sides' errors over |s - r|, and
// as much, times its length, is the point off along the edge. With d the largest such error of the
// four points, the direction of the longer interval (of length l) is off by an angle of 2 d / l,
// which shortens what lies within it by 2 d at most, and each end of the common piece by d more:
// the result is within 6 d. Evaluating points and projections costs below 100 e of the size.
#include "reference/oracle/intersection_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/types/vec3.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/floating_point.h"

namespace contactcheck::oracle {
namespace {

constexpr double kSideRounding = 64 * 0x1p-53;

// Accepted error of a point on the common line, in fractions of the triangles' size: six times this
// is below what is promised. Smaller: more rational arithmetic.
constexpr double kPointAccuracy = 1e-10;

// Sizes whose fourth power neither overflows nor underflows.
constexpr double kSmallest = 0x1p-200, kLargest = 0x1p+200;

// Products of lengths above this keep clear of underflow, to which the analysis is blind.
constexpr double kSmallestProduct = 0x1p-900;

double largest(const Vec3& v) { return v.cwiseAbs().maxCoeff(); }

// On which side of a plane the corners of a triangle lie; each value within its error of the truth.
struct Sides {
  std::array<double, 3> value, error;

  bool certain() const {
    return std::abs(value[0]) > error[0] && std::abs(value[1]) > error[1] &&
           std::abs(value[2]) > error[2];
  }
  bool same(int i, int j) const { return (value[i] > 0) == (value[j] > 0); }
  bool all_same() const { return same(0, 1) && same(1, 2); }
  /// The corner that is alone on its side. @pre certain, not all the same
  int alone() const { return same(1, 2) ? 0 : same(0, 2) ? 1 : 2; }
};

Sides sides_of(const TriangleCorners& points, const TriangleCorners& plane) {
  const Vec3 u = plane[1] - plane[0], v = plane[2] - plane[0], normal = u.cross(v);
  Sides out;
  for (int k = 0; k < 3; ++k) {
    const Vec3 w = points[k] - plane[0];
    const double area = largest(u) * largest(v), volume = area * largest(w);
    out.value[k] = normal.dot(w);
    out.error[k] = std::min(area, volume) > kSmallestProduct
                       ? kSideRounding * volume
                       : std::numeric_limits<double>::infinity();
  }
  return out;
}

struct Interval {
  Vec3 from, to;
  double error = 0.0;  // of either point along its edge
};

// The point, relative to `origin`, where the edge from corner i to corner j passes through the
// plane.
Vec3 passage(const TriangleCorners& t, const Sides& sides, int i, int j, const Vec3& origin,
             double& error) {
  const Vec3 edge = t[j] - t[i];
  const double span = sides.value[i] - sides.value[j];
  error = std::max(error, 2 * (sides.error[i] + sides.error[j]) / std::abs(span) * edge.norm());
  return (t[i] - origin) + edge * (sides.value[i] / span);
}

Interval interval_of(const TriangleCorners& t, const Sides& sides, const Vec3& origin) {
  const int i = sides.alone();
  Interval out;
  out.from = passage(t, sides, i, (i + 1) % 3, origin, out.error);
  out.to = passage(t, sides, i, (i + 2) % 3, origin, out.error);
  return out;
}

// What two intervals of one line have in common.
double common_length(const Interval& p, const Interval& q) {
  const Vec3 p_span = p.to - p.from, q_span = q.to - q.from;
  const bool p_longer = p_span.squaredNorm() >= q_span.squaredNorm();
  const Vec3 span = p_longer ? p_span : q_span, start = p_longer ? p.from : q.from;
  const double length = span.norm();
  if (!(length > 0)) return 0.0;
  const auto along = [&](const Vec3& x) { return span.dot(x - start) / length; };
  const auto [p_low, p_high] = std::minmax({along(p.from), along(p.to)});
  const auto [q_low, q_high] = std::minmax({along(q.from), along(q.to)});
  return std::max(0.0, std::min(p_high, q_high) - std::max(p_low, q_low));
}

}  // namespace

std::optional<double> crossing_length(const TriangleCorners& p, const TriangleCorners& q) {
  const Aabb p_box = box_of(p), q_box = box_of(q);
  if (!p_box.overlaps(q_box)) return 0.0;
  const double size = std::max(p_box.extent().maxCoeff(), q_box.extent().maxCoeff());
  if (!(size >= kSmallest && size <= kLargest)) return std::nullopt;
  const Sides p_sides = sides_of(p, q), q_sides = sides_of(q, p);
  if (!p_sides.certain() || !q_sides.certain()) return std::nullopt;
  if (p_sides.all_same() || q_sides.all_same()) return 0.0;
  const Interval in_p = interval_of(p, p_sides, p[0]), in_q = interval_of(q, q_sides, p[0]);
  if (std::max(in_p.error, in_q.error) > kPointAccuracy * size) return std::nullopt;
  return common_length(in_p, in_q);
}

double intersection_length(const TriangleCorners& p, const TriangleCorners& q) {
  if (const std::optional<double> length = crossing_length(p, q)) return *length;
  return triangles_intersect(p, q) ? exact_intersection_length(p, q) : 0.0;
}

}  // namespace contactcheck::oracle
