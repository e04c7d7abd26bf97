#include "reference/certify/certificate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/certify/nearest_points.h"
#include "reference/oracle/scaling.h"

namespace contactcheck::certify {
namespace {

using oracle::TriangleCorners;

constexpr int kHex = 16;

std::array<std::string, 3> integer_weights(const std::array<mpq_class, 3>& weights) {
  mpz_class denominator = 1;
  for (const mpq_class& w : weights) denominator = lcm(denominator, w.get_den());
  std::array<std::string, 3> out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = mpq_class(weights[k] * denominator).get_num().get_str(kHex);
  return out;
}

// Directions among which one parts two disjoint triangles, if at least one is proper or they are
// segments on two lines: normals, products of edges, and normals within the planes. In doubles: a
// guess, to be verified.
std::vector<Vec3> directions(const TriangleCorners& p, const TriangleCorners& q) {
  std::array<Vec3, 6> edges;
  for (std::size_t k = 0; k < 3; ++k) {
    edges[k] = p[(k + 1) % 3] - p[k];
    edges[3 + k] = q[(k + 1) % 3] - q[k];
  }
  std::vector<Vec3> out = {edges[0].cross(edges[1]), edges[3].cross(edges[4])};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 3; j < 6; ++j) out.push_back(edges[i].cross(edges[j]));
  const std::size_t count = out.size();
  for (std::size_t n = 0; n < count; ++n)
    for (const Vec3& edge : edges) out.push_back(out[n].cross(edge));
  return out;
}

// How far a unit direction parts the two, from p to q; negative: it does not.
double gap_along(const Vec3& unit, const TriangleCorners& p, const TriangleCorners& q) {
  return std::min({unit.dot(q[0]), unit.dot(q[1]), unit.dot(q[2])}) -
         std::max({unit.dot(p[0]), unit.dot(p[1]), unit.dot(p[2])});
}

// Both moved to the origin and brought to a size near 1: where squares neither overflow nor vanish.
std::array<TriangleCorners, 2> normalized(const TriangleCorners& p, const TriangleCorners& q) {
  std::array<TriangleCorners, 2> out = {p, q};
  double size = 0;
  for (TriangleCorners& t : out)
    for (Vec3& corner : t) {
      corner -= p[0];
      size = std::max(size, corner.cwiseAbs().maxCoeff());
    }
  for (TriangleCorners& t : out)
    for (Vec3& corner : t) corner = oracle::scaled_by_two_to(-oracle::exponent_above(size), corner);
  return out;
}

// The best direction that doubles find.
std::optional<Vec3> likely_normal(const TriangleCorners& p, const TriangleCorners& q) {
  const auto [a, b] = normalized(p, q);
  double best = 0;
  std::optional<Vec3> out;
  for (const Vec3& direction : directions(a, b)) {
    const double length = direction.norm();
    if (!std::isfinite(length) || length == 0) continue;
    for (const Vec3& unit : {Vec3(direction / length), Vec3(-direction / length)}) {
      const double gap = gap_along(unit, a, b);
      if (!(gap > best)) continue;
      best = gap;
      out = unit;
    }
  }
  return out;
}

ExactNumber rational_text(const mpq_class& value) { return value.get_str(kHex); }

// A double in [low, high) if the middle rounds to one, else low.
ExactNumber offset_between(const mpq_class& low, const mpq_class& high) {
  const double middle = mpq_class((low + high) / 2).get_d();
  if (std::isfinite(middle) && low <= middle && high > middle) return middle;
  return rational_text(low);
}

// The plane across a normal, where that parts the two: decided exactly.
std::optional<Plane> plane_across(const Vec3& normal, const RationalTriangle& p,
                                  const RationalTriangle& q) {
  const RationalPoint n = to_rational(normal);
  const mpq_class low = std::max({dot(n, p[0]), dot(n, p[1]), dot(n, p[2])});
  const mpq_class high = std::min({dot(n, q[0]), dot(n, q[1]), dot(n, q[2])});
  if (low >= high) return std::nullopt;
  return Plane{{normal.x(), normal.y(), normal.z()}, offset_between(low, high)};
}

// Of two disjoint closed convex sets, with nearest points x and y: no point of the first lies
// further along y - x than x, or moving x towards it would come nearer to y; likewise none of the
// second lies less far than y. So the plane through x across y - x, which is not 0, separates
// strictly whatever the two are: faces, segments or points.
Plane plane_at(const NearestPoints& nearest) {
  const RationalPoint normal = nearest.on_q.at - nearest.on_p.at;
  return {{rational_text(normal[0]), rational_text(normal[1]), rational_text(normal[2])},
          rational_text(dot(normal, nearest.on_p.at))};
}

}  // namespace

std::optional<Witness> common_point(const TriangleCorners& p, const TriangleCorners& q) {
  const NearestPoints nearest = nearest_points(to_rational(p), to_rational(q));
  if (nearest.squared_distance != 0) return std::nullopt;
  return Witness{integer_weights(nearest.on_p.weights), integer_weights(nearest.on_q.weights)};
}

std::optional<Plane> separating_plane(const TriangleCorners& p, const TriangleCorners& q) {
  const RationalTriangle a = to_rational(p), b = to_rational(q);
  if (const auto normal = likely_normal(p, q))
    if (auto plane = plane_across(*normal, a, b)) return plane;
  const NearestPoints nearest = nearest_points(a, b);
  if (nearest.squared_distance == 0) return std::nullopt;
  return plane_at(nearest);
}

}  // namespace contactcheck::certify
