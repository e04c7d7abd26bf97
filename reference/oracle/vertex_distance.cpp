// In coordinates relative to the vertex, a computed point of the triangle bounds the distance from
// above, the triangle's extent along any direction from below, however rounded both are.
//
// Rounding, with e = 2^-53 and M = the largest |coordinate| of a corner relative to the vertex. The
// differences are off by e M. A computed point a + (b - a) s + (c - a) t, with s, t >= 0 and s + t
// <= 1 + e, is off by less than 20 e M per coordinate from a point of the triangle, so by 35 e M in
// length; its own length is rounded by less than 8 e M. Along a direction whose length is 1 up to
// 6 e, a corner's extent is off by 11 e M for that, 2 e M for the differences, 6 e M for the dot
// product. All is below 64 e M. Within the range of M that is let through, what underflows is
// below 2^-500 M.
#include "reference/oracle/vertex_distance.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace contactcheck::oracle {
namespace {

using Rational = CGAL::Exact_rational;
using RelativeVector = CGAL::Simple_cartesian<Rational>::Vector_3;
using RelativeCorners = std::array<RelativeVector, 3>;

// Twice what the analysis above asks for; relative to M.
constexpr double kVertexRounding = 128 * 0x1p-53;

// Within, M to the fourth power and its fraction 2^-100 are normal numbers.
constexpr double kSmallestSize = 0x1p-200, kLargestSize = 0x1p+200;

// Directions shorter than this times their natural size are rounding; they bound nothing.
constexpr double kShortest = 0x1p-50;

double largest_of(const TriangleCorners& t) {
  return std::max(
      {t[0].cwiseAbs().maxCoeff(), t[1].cwiseAbs().maxCoeff(), t[2].cwiseAbs().maxCoeff()});
}

// The point of a segment that is nearest to the origin, up to rounding.
Vec3 nearest_on_edge(const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double along = -d.dot(a), length2 = d.squaredNorm();
  if (!(along > 0)) return a;
  return along < length2 ? Vec3(a + d * (along / length2)) : b;
}

// Keeps x if it is nearer to the origin than the best one so far.
void offer(const Vec3& x, Vec3& best) {
  if (x.squaredNorm() < best.squaredNorm()) best = x;
}

void offer_face(const TriangleCorners& t, const Vec3& normal, Vec3& best) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double n2 = normal.squaredNorm();
  const double s = v.cross(t[0]).dot(normal) / n2, r = t[0].cross(u).dot(normal) / n2;
  if (s >= 0 && r >= 0 && s + r <= 1) offer(t[0] + u * s + v * r, best);
}

// How far from the origin the triangle begins along a direction of any length, in either sense.
double gap_along(const Vec3& direction, const TriangleCorners& t) {
  const Vec3 unit = direction / direction.norm();
  const auto [low, high] = std::minmax({unit.dot(t[0]), unit.dot(t[1]), unit.dot(t[2])});
  return std::max(low, -high);
}

Vec3 nearest_to_origin(const TriangleCorners& t, const Vec3& normal, bool proper) {
  Vec3 best = nearest_on_edge(t[0], t[1]);
  offer(nearest_on_edge(t[1], t[2]), best);
  offer(nearest_on_edge(t[2], t[0]), best);
  if (proper) offer_face(t, normal, best);
  return best;
}

RelativeCorners exactly_relative(const Vec3& vertex, const TriangleCorners& t) {
  const auto convert = [&](const Vec3& p) {
    return RelativeVector(Rational(p.x()) - Rational(vertex.x()),
                          Rational(p.y()) - Rational(vertex.y()),
                          Rational(p.z()) - Rational(vertex.z()));
  };
  return {convert(t[0]), convert(t[1]), convert(t[2])};
}

struct ExactNearest {
  RelativeVector offset;
  Rational squared;

  void offer(const RelativeVector& x) {
    const Rational x2 = x * x;
    if (x2 < squared) *this = {x, x2};
  }
};

RelativeVector exact_on_edge(const RelativeVector& a, const RelativeVector& b) {
  const RelativeVector d = b - a;
  const Rational along = -(d * a), length2 = d * d;
  if (along <= 0) return a;
  return along < length2 ? RelativeVector(a + d * (along / length2)) : b;
}

void offer_exact_face(const RelativeCorners& t, ExactNearest& best) {
  const RelativeVector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  const Rational n2 = n * n;
  if (n2 == 0) return;
  for (int k = 0; k < 3; ++k)
    if (CGAL::cross_product(t[k], t[(k + 1) % 3]) * n < 0) return;
  best.offer(n * (n * t[0] / n2));
}

ExactNearest exact_nearest(const RelativeCorners& t) {
  ExactNearest best{t[0], t[0] * t[0]};
  for (int k = 0; k < 3; ++k) best.offer(exact_on_edge(t[k], t[(k + 1) % 3]));
  offer_exact_face(t, best);
  return best;
}

// A rounded distance to a box exceeds the true one by less than 8 * 2^-53 of it.
constexpr double kBoxDistanceRounding = 1 - 16 * 0x1p-53;

}  // namespace

double distance_to(const Aabb& box, const Vec3& point) {
  return (box.lo - point).cwiseMax(point - box.hi).cwiseMax(0.0).norm() * kBoxDistanceRounding;
}

NearestPoint nearest_point(const Vec3& vertex, const TriangleCorners& triangle) {
  const TriangleCorners t{triangle[0] - vertex, triangle[1] - vertex, triangle[2] - vertex};
  const double size = largest_of(t);
  NearestPoint out;
  out.upper = std::numeric_limits<double>::infinity();
  if (!(size >= kSmallestSize && size <= kLargestSize)) return out;
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const bool proper = normal.norm() > kShortest * size * size;
  out.offset = nearest_to_origin(t, normal, proper);
  const double length = out.offset.norm();
  double gap = 0.0;
  if (length > kShortest * size) gap = gap_along(out.offset, t);
  if (proper) gap = std::max(gap, gap_along(normal, t));
  out.lower = std::max(0.0, gap - kVertexRounding * size);
  out.upper = length + kVertexRounding * size;
  return out;
}

NearestPoint exact_nearest_point(const Vec3& vertex, const TriangleCorners& triangle) {
  const ExactNearest best = exact_nearest(exactly_relative(vertex, triangle));
  const auto [low, high] = CGAL::to_interval(best.squared);
  NearestPoint out;
  for (int axis = 0; axis < 3; ++axis) out.offset[axis] = CGAL::to_double(best.offset[axis]);
  if (best.squared == 0) return out;
  // sqrt rounds correctly, so one step outward is a bound.
  out.lower = std::max(0.0, std::nextafter(std::sqrt(std::max(0.0, low)), 0.0));
  out.upper = std::nextafter(std::sqrt(high), std::numeric_limits<double>::infinity());
  return out;
}

bool nearer_than(double margin, const Vec3& vertex, const TriangleCorners& triangle) {
  const NearestPoint near = nearest_point(vertex, triangle);
  if (near.upper < margin) return true;
  if (near.lower >= margin) return false;
  const Rational exact_margin(margin);
  return margin > 0 &&
         exact_nearest(exactly_relative(vertex, triangle)).squared < exact_margin * exact_margin;
}

}  // namespace contactcheck::oracle
