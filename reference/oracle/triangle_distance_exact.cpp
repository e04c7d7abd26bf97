#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/triangle_distance.h"

namespace contactcheck::oracle {
namespace {

using Rational = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Corners3 = std::array<Point, 3>;

Corners3 to_rational(const TriangleCorners& t) {
  const auto convert = [](const Vec3& v) {
    return Point(Rational(v.x()), Rational(v.y()), Rational(v.z()));
  };
  return {convert(t[0]), convert(t[1]), convert(t[2])};
}

class Minimum {
 public:
  explicit Minimum(Rational first) : value_(std::move(first)) {}
  void offer(const Rational& value) {
    if (value < value_) value_ = value;
  }
  const Rational& value() const { return value_; }

 private:
  Rational value_;
};

Rational squared_to_segment(const Point& p, const Point& a, const Point& b) {
  const Vector d = b - a, w = p - a;
  const Rational along = w * d, length2 = d * d;
  if (along <= 0) return w * w;
  if (along >= length2) return (p - b) * (p - b);
  return w * w - along * along / length2;
}

// Distance to the plane where the point projects into the proper face.
void offer_face(const Point& p, const Corners3& t, Minimum& best) {
  const Vector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  const Rational n2 = n * n;
  if (n2 == 0) return;
  for (int k = 0; k < 3; ++k)
    if (CGAL::cross_product(t[(k + 1) % 3] - t[k], p - t[k]) * n < 0) return;
  const Rational height = n * (p - t[0]);
  best.offer(height * height / n2);
}

// Distance of the two lines where their nearest points lie within both segments.
void offer_edges(const Point& a, const Point& b, const Point& c, const Point& d, Minimum& best) {
  const Vector u = b - a, v = d - c, w = a - c;
  const Rational uu = u * u, uv = u * v, vv = v * v;
  const Rational det = uu * vv - uv * uv;
  if (det == 0) return;
  const Rational wu = w * u, wv = w * v;
  const Rational s = uv * wv - vv * wu, r = uu * wv - uv * wu;
  if (s < 0 || s > det || r < 0 || r > det) return;
  const Rational height = CGAL::cross_product(u, v) * w;
  best.offer(height * height / det);
}

void offer_corners(const Corners3& p, const Corners3& q, Minimum& best) {
  for (const Point& corner : p) {
    for (int k = 0; k < 3; ++k) best.offer(squared_to_segment(corner, q[k], q[(k + 1) % 3]));
    offer_face(corner, q, best);
  }
}

// Outward square roots: sqrt rounds correctly, so one step more is a bound.
DistanceBounds root_of(const Rational& squared) {
  const auto [low, high] = CGAL::to_interval(squared);
  return {std::max(0.0, std::nextafter(std::sqrt(std::max(0.0, low)), 0.0)),
          std::nextafter(std::sqrt(high), std::numeric_limits<double>::infinity())};
}

}  // namespace

DistanceBounds exact_distance_bounds(const TriangleCorners& p, const TriangleCorners& q) {
  if (triangles_intersect(p, q)) return {0.0, 0.0};
  const Corners3 a = to_rational(p), b = to_rational(q);
  Minimum best((b[0] - a[0]) * (b[0] - a[0]));
  offer_corners(a, b, best);
  offer_corners(b, a, best);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) offer_edges(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], best);
  return root_of(best.value());
}

}  // namespace contactcheck::oracle
