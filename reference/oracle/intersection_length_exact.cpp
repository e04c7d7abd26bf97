// Every extreme point x of the intersection lies on an edge of one of the two triangles: inside
// both, the intersection goes on to both sides of x. Where x lies on an edge of p, it is an extreme
// point of what q leaves of that edge. So the ends of all six clipped edges hold all extreme
// points, and their diameter is the intersection's, coplanar and degenerate triangles included.
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "reference/oracle/floating_point.h"
#include "reference/oracle/intersection_length.h"

namespace contactcheck::oracle {
namespace {

using Rational = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Corners3 = std::array<Point, 3>;

// The points x with normal * (x - through) >= 0; or = 0, where it is flat.
struct HalfSpace {
  Vector normal;
  Point through;
  bool flat;
};

// The powers of two that are normal numbers, so that their reciprocals are too.
constexpr int kLargestExponent = 1000;

Corners3 scaled_rational(const TriangleCorners& t, int exponent) {
  const Rational factor(std::ldexp(1.0, -exponent));
  const auto convert = [&](const Vec3& v) {
    return Point(Rational(v.x()) * factor, Rational(v.y()) * factor, Rational(v.z()) * factor);
  };
  return {convert(t[0]), convert(t[1]), convert(t[2])};
}

std::vector<HalfSpace> of_proper(const Corners3& t, const Vector& normal) {
  std::vector<HalfSpace> out{{normal, t[0], true}};
  for (int k = 0; k < 3; ++k)
    out.push_back({CGAL::cross_product(normal, t[(k + 1) % 3] - t[k]), t[k], false});
  return out;
}

std::vector<HalfSpace> of_point(const Point& p) {
  return {{Vector(1, 0, 0), p, true}, {Vector(0, 1, 0), p, true}, {Vector(0, 0, 1), p, true}};
}

std::vector<HalfSpace> of_segment(const Point& from, const Point& to) {
  const Vector d = to - from;
  if (d * d == 0) return of_point(from);
  std::vector<HalfSpace> out{{d, from, false}, {-d, to, false}};
  // (x - from) x d = 0
  for (const Vector& axis : {Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)})
    out.push_back({CGAL::cross_product(d, axis), from, true});
  return out;
}

// A closed triangle as the half-spaces whose intersection it is.
std::vector<HalfSpace> half_spaces(const Corners3& t) {
  const Vector normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  if (normal * normal != 0) return of_proper(t, normal);
  const auto [low, high] = std::minmax_element(t.begin(), t.end());  // lexicographic
  return of_segment(*low, *high);
}

// The part of a segment, by its parameters, that some half-spaces leave; empty when low > high.
struct Clip {
  Rational low = 0, high = 1;

  void keep_positive(const Rational& at_from, const Rational& at_to) {
    if (at_from < 0 && at_to < 0) {
      low = 2;
    } else if (at_from < 0) {
      low = std::max(low, Rational(at_from / (at_from - at_to)));
    } else if (at_to < 0) {
      high = std::min(high, Rational(at_from / (at_from - at_to)));
    }
  }
};

void append_ends(const Point& from, const Point& to, const std::vector<HalfSpace>& bounds,
                 std::vector<Point>& ends) {
  Clip clip;
  for (const HalfSpace& bound : bounds) {
    const Rational at_from = bound.normal * (from - bound.through);
    const Rational at_to = bound.normal * (to - bound.through);
    clip.keep_positive(at_from, at_to);
    if (bound.flat) clip.keep_positive(-at_from, -at_to);
    if (clip.low > clip.high) return;
  }
  ends.push_back(from + (to - from) * clip.low);
  if (clip.low < clip.high) ends.push_back(from + (to - from) * clip.high);
}

Rational squared_diameter(const std::vector<Point>& points) {
  Rational best = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      best = std::max(best, Rational((points[i] - points[j]).squared_length()));
  return best;
}

}  // namespace

double exact_intersection_length(const TriangleCorners& p, const TriangleCorners& q) {
  const int exponent = std::clamp(exponent_above(std::max(largest_side(p), largest_side(q))),
                                  -kLargestExponent, kLargestExponent);
  const Corners3 a = scaled_rational(p, exponent), b = scaled_rational(q, exponent);
  const std::vector<HalfSpace> of_a = half_spaces(a), of_b = half_spaces(b);
  std::vector<Point> ends;
  for (int k = 0; k < 3; ++k) {
    append_ends(a[k], a[(k + 1) % 3], of_b, ends);
    append_ends(b[k], b[(k + 1) % 3], of_a, ends);
  }
  return std::ldexp(std::sqrt(CGAL::to_double(squared_diameter(ends))), exponent);
}

}  // namespace contactcheck::oracle
