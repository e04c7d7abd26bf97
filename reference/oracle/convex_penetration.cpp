// A translation t of B meets A exactly when t lies in the Minkowski difference D = A - B, which
// holds 0. So the penetration depth is the distance from 0 to the boundary of D, and D being the
// intersection of the half-spaces of its facets, that is the least extent h(n) = max n A - min n B
// over the outward normals n of its facets.
//
// A facet of D is the sum of the faces of A and of -B in its direction, and spans a plane. Either
// one of the two does: n is a face's normal. Or both are edges, not parallel: n is their product.
// Where D is flat its two "facets" are D itself: again A or B spans the plane, or two edges do, and
// h(n) = 0. Where D is a segment or a point, all those vectors are zero and every direction across
// it has depth 0. Directions too many (of diagonals within a face, both signs) do no harm: h(n) is
// never less than the distance.
//
// Rounding, with e = 2^-53. Coordinates are taken relative to one point and in units of the size.
// A product of vectors that are nearly parallel keeps little of its direction in double; then it is
// formed in twice the precision, from exact differences: off by less than 16 e^2 |u| |v|. Above a
// sine of 2^-50 its direction is right to 2e-16; from a sine of 1/64 on, the plain product's is to
// 64 * 16 e = 2e-13 at most. Below 2^-50 the product is left out: its facet is a parallelogram
// narrower than 2^-50 of the size, so that a neighbour, the next across its long sides that is not
// that thin, is as near but for a few times that. So is a product below 2^-300, whose square could
// underflow: its facet is narrower than 2^-150.
#include "reference/oracle/convex_penetration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reference/oracle/floating_point.h"

namespace contactcheck::oracle {
namespace {

// Sines: below the first the plain product is not trusted, below the second none is.
constexpr double kNearlyParallel = 1.0 / 64, kParallel = 0x1p-50;
// In units of the size squared.
constexpr double kShortestProduct = 0x1p-300;

// high + low, exactly, with |low| at most half a unit in the last place of high.
struct TwoDoubles {
  double high, low;
};

TwoDoubles exact_sum(double a, double b) {
  const double sum = a + b, b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

TwoDoubles exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

// A difference of two points: exact, in two parts.
struct Difference {
  Vec3 high, low;
};

Difference difference_of(const Vec3& p, const Vec3& q, int exponent) {
  Difference d;
  for (int k = 0; k < 3; ++k) {
    const TwoDoubles x = exact_sum(p[k], -q[k]);
    d.high[k] = std::ldexp(x.high, -exponent);
    d.low[k] = std::ldexp(x.low, -exponent);
  }
  return d;
}

// u[i] v[j] - u[j] v[i] in twice the precision.
double minor_of(const Difference& u, const Difference& v, int i, int j) {
  const TwoDoubles p = exact_product(u.high[i], v.high[j]), q = exact_product(u.high[j], v.high[i]);
  const TwoDoubles high = exact_sum(p.high, -q.high);
  const double low =
      (u.high[i] * v.low[j] + u.low[i] * v.high[j]) - (u.high[j] * v.low[i] + u.low[j] * v.high[i]);
  return high.high + (high.low + ((p.low - q.low) + low));
}

// The direction across both, of unit length; zero if they are parallel.
Vec3 normal_of(const Difference& u, const Difference& v) {
  const double lengths = u.high.norm() * v.high.norm();
  Vec3 n = u.high.cross(v.high);
  if (n.norm() < kNearlyParallel * lengths)
    n = Vec3(minor_of(u, v, 1, 2), minor_of(u, v, 2, 0), minor_of(u, v, 0, 1));
  const double length = n.norm();
  return length > std::max(kParallel * lengths, kShortestProduct) ? Vec3(n / length) : Vec3::Zero();
}

bool pair_less(const std::pair<Vec3, Vec3>& x, const std::pair<Vec3, Vec3>& y) {
  if (x.first != y.first) return lexicographically_less(x.first, y.first);
  return lexicographically_less(x.second, y.second);
}

// One of the two pieces, relative to `origin` and in units of 2^exponent.
struct Piece {
  std::vector<Vec3> points;
  std::vector<Difference> edges;
  std::vector<Vec3> normals;

  Piece(PieceSurface surface, const Vec3& origin, int exponent);
};

std::vector<std::pair<Vec3, Vec3>> sides_of(PieceSurface surface) {
  std::vector<std::pair<Vec3, Vec3>> sides;
  for (const TriangleCorners& t : surface)
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = t[k], &q = t[(k + 1) % 3];
      if (p != q) sides.push_back(lexicographically_less(p, q) ? std::pair(p, q) : std::pair(q, p));
    }
  std::sort(sides.begin(), sides.end(), pair_less);
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

Piece::Piece(PieceSurface surface, const Vec3& origin, int exponent) {
  std::vector<Vec3> corners;
  for (const TriangleCorners& t : surface) {
    corners.insert(corners.end(), t.begin(), t.end());
    const Vec3 n =
        normal_of(difference_of(t[1], t[0], exponent), difference_of(t[2], t[0], exponent));
    if (n != Vec3::Zero()) normals.push_back(n);
  }
  std::sort(corners.begin(), corners.end(), lexicographically_less);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const Vec3& p : corners) points.push_back(scaled_by_two_to(-exponent, p - origin));
  for (const auto& [p, q] : sides_of(surface)) edges.push_back(difference_of(p, q, exponent));
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Extent extent_of(const std::vector<Vec3>& points, const Vec3& unit) {
  Extent out;
  for (const Vec3& p : points) {
    const double x = unit.dot(p);
    out.low = std::min(out.low, x);
    out.high = std::max(out.high, x);
  }
  return out;
}

}  // namespace

void add_direction(const Vec3& direction, std::vector<Vec3>& directions) {
  const bool there = std::any_of(directions.begin(), directions.end(), [&](const Vec3& d) {
    return (d - direction).norm() < kSameDirection;
  });
  if (!there) directions.push_back(direction);
}

Penetration convex_penetration(PieceSurface a, PieceSurface b, double tolerance) {
  Aabb box;
  for (PieceSurface surface : {a, b})
    for (const TriangleCorners& t : surface)
      for (const Vec3& p : t) box.extend(p);
  const int exponent = exponent_above(box.extent().maxCoeff());
  const Piece in_a(a, a[0][0], exponent), in_b(b, a[0][0], exponent);
  const double scaled_tolerance = std::ldexp(tolerance, -exponent);

  struct Offer {
    double depth;
    Vec3 direction;
  };
  double best = std::numeric_limits<double>::infinity();
  std::vector<Offer> offers;  // all that were as good as the best one when they came
  const auto offer = [&](double depth, const Vec3& unit) {
    if (depth > best + scaled_tolerance) return;
    best = std::min(best, std::max(0.0, depth));
    offers.push_back({depth, unit});
  };
  const auto try_both_signs = [&](const Vec3& unit) {
    if (unit == Vec3::Zero()) return;
    const Extent along_a = extent_of(in_a.points, unit), along_b = extent_of(in_b.points, unit);
    offer(along_a.high - along_b.low, unit);
    offer(along_b.high - along_a.low, -unit);
  };
  for (const Vec3& normal : in_a.normals) try_both_signs(normal);
  for (const Vec3& normal : in_b.normals) try_both_signs(normal);
  for (const Difference& u : in_a.edges)
    for (const Difference& v : in_b.edges) try_both_signs(normal_of(u, v));
  if (offers.empty()) {
    // All edges are parallel: two directions across them, or all axes without any.
    const std::vector<Difference>& edges = in_a.edges.empty() ? in_b.edges : in_a.edges;
    if (edges.empty()) {
      for (int axis = 0; axis < 3; ++axis) try_both_signs(Vec3::Unit(axis));
    } else {
      const Vec3 along = edges.front().high.normalized();
      int axis = 0;
      along.cwiseAbs().minCoeff(&axis);
      const Vec3 across = along.cross(Vec3::Unit(axis)).normalized();
      try_both_signs(across);
      try_both_signs(along.cross(across).normalized());
    }
  }

  Penetration out;
  out.depth = std::ldexp(best, exponent);
  std::erase_if(offers, [&](const Offer& o) { return o.depth > best + scaled_tolerance; });
  std::stable_sort(offers.begin(), offers.end(),
                   [](const Offer& x, const Offer& y) { return x.depth < y.depth; });
  for (const Offer& o : offers) add_direction(o.direction, out.directions);
  return out;
}

}  // namespace contactcheck::oracle
