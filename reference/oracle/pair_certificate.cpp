#include "reference/oracle/pair_certificate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reference/oracle/floating_point.h"
#include "reference/oracle/rational_geometry.h"

namespace contactcheck::oracle::certify {
namespace {

using rational::cross;
using rational::dot;
using rational::operator-;
using rational::to_rational;
using RationalPoint = rational::Point;
using RationalTriangle = rational::PointTriple;

/// A point of a triangle: the sum of its corners times the weights, which are not negative and add
/// up to 1.
struct TrianglePoint {
  RationalPoint at;
  std::array<mpq_class, 3> weights;
};

/// The same point twice exactly when the triangles share one.
struct NearestPoints {
  TrianglePoint on_p, on_q;
  mpq_class squared_distance;
};

struct Piece {
  explicit Piece(const RationalTriangle& triangle)
      : corners(triangle),
        normal(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])),
        squared_normal(dot(normal, normal)) {}

  bool proper() const { return squared_normal != 0; }
  RationalPoint edge(std::size_t k) const { return corners[(k + 1) % 3] - corners[k]; }

  RationalTriangle corners;
  RationalPoint normal;
  mpq_class squared_normal;
};

TrianglePoint point_at(const Piece& piece, const std::array<mpq_class, 3>& weights) {
  TrianglePoint out{{}, weights};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < 3; ++k) out.at[axis] += weights[k] * piece.corners[k][axis];
  return out;
}

TrianglePoint point_on_edge(const Piece& piece, std::size_t k, const mpq_class& along) {
  std::array<mpq_class, 3> weights;
  weights[k] = 1 - along;
  weights[(k + 1) % 3] = along;
  return point_at(piece, weights);
}

TrianglePoint nearest_on_edge(const Piece& piece, std::size_t k, const RationalPoint& x) {
  const RationalPoint edge = piece.edge(k);
  const mpq_class length = dot(edge, edge);
  if (length == 0) return point_on_edge(piece, k, 0);
  const mpq_class along = dot(x - piece.corners[k], edge) / length;
  return point_on_edge(piece, k, std::clamp(along, mpq_class(0), mpq_class(1)));
}

// The foot of the perpendicular, where it falls on a proper face.
std::optional<TrianglePoint> foot_on_face(const Piece& piece, const RationalPoint& x) {
  if (!piece.proper()) return std::nullopt;
  std::array<mpq_class, 3> weights;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const mpq_class area = dot(cross(piece.edge(next), x - piece.corners[next]), piece.normal);
    if (area < 0) return std::nullopt;
    weights[k] = area / piece.squared_normal;
  }
  return point_at(piece, weights);
}

/// On the hull of the first `count` corners, one or two?
bool on_first_corners(const RationalTriangle& t, std::uint32_t count, const RationalPoint& x) {
  const RationalPoint edge = t[count - 1] - t[0], to = x - t[0];
  const mpq_class along = dot(to, edge), length = dot(edge, edge);
  if (length == 0) return x == t[0];
  return cross(to, edge) == RationalPoint{} && along >= 0 && along <= length;
}

// Every offer tells whether the triangles are known to meet: then nothing is nearer. With `shared`
// corners, the first of both: whether they are known to meet elsewhere; nothing else is of
// interest.
class Search {
 public:
  Search(const RationalTriangle& p, const RationalTriangle& q, std::uint32_t shared = 0)
      : p_(p), q_(q), shared_(shared) {}

  std::optional<NearestPoints> run() {
    // Crossings first: most triangles that meet have one.
    if (!offer_crossings(p_, q_) && !offer_crossings(q_, p_) && !offer_feet(p_, q_) &&
        !offer_feet(q_, p_) && !offer_edges() && !offer_corners(p_, q_))
      offer_corners(q_, p_);
    return std::move(best_);
  }

 private:
  bool offer(const Piece& first, TrianglePoint a, TrianglePoint b) {
    const RationalPoint apart = b.at - a.at;
    mpq_class squared = dot(apart, apart);
    if (best_ && best_->squared_distance <= squared) return false;
    if (shared_ > 0 && (squared != 0 || on_first_corners(p_.corners, shared_, a.at))) return false;
    if (&first != &p_) std::swap(a, b);
    best_ = NearestPoints{std::move(a), std::move(b), std::move(squared)};
    return best_->squared_distance == 0;
  }

  bool offer_crossings(const Piece& edges, const Piece& face) {
    if (!face.proper()) return false;
    std::array<mpq_class, 3> height;
    for (std::size_t k = 0; k < 3; ++k)
      height[k] = dot(face.normal, edges.corners[k] - face.corners[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const mpq_class &from = height[k], &to = height[(k + 1) % 3];
      if (sgn(from) * sgn(to) >= 0) continue;  // a corner in the plane is no crossing
      const TrianglePoint x = point_on_edge(edges, k, from / (from - to));
      const auto y = foot_on_face(face, x.at);
      if (y && offer(edges, x, *y)) return true;
    }
    return false;
  }

  bool offer_feet(const Piece& corners, const Piece& face) {
    for (std::size_t k = 0; k < 3; ++k) {
      const TrianglePoint x = point_on_edge(corners, k, 0);
      const auto y = foot_on_face(face, x.at);
      if (y && offer(corners, x, *y)) return true;
    }
    return false;
  }

  bool offer_corners(const Piece& corners, const Piece& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      const TrianglePoint x = point_on_edge(corners, k, 0);
      for (std::size_t edge = 0; edge < 3; ++edge)
        if (offer(corners, x, nearest_on_edge(other, edge, x.at))) return true;
    }
    return false;
  }

  bool offer_edges() {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (offer_lines(i, j)) return true;
    return false;
  }

  // The nearest points of two lines that are not parallel, where they lie within both edges.
  bool offer_lines(std::size_t i, std::size_t j) {
    const RationalPoint u = p_.edge(i), v = q_.edge(j), w = p_.corners[i] - q_.corners[j];
    const mpq_class uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
    const mpq_class det = uu * vv - uv * uv;
    if (det == 0) return false;
    const mpq_class wu = dot(w, u), wv = dot(w, v);
    const mpq_class s = (uv * wv - vv * wu) / det, r = (uu * wv - uv * wu) / det;
    if (s < 0 || s > 1 || r < 0 || r > 1) return false;
    return offer(p_, point_on_edge(p_, i, s), point_on_edge(q_, j, r));
  }

  const Piece p_, q_;
  const std::uint32_t shared_;
  std::optional<NearestPoints> best_;
};

// Degenerate triangles are the segment or the point that they are. @pre all coordinates finite
NearestPoints nearest_points(const RationalTriangle& p, const RationalTriangle& q) {
  return *Search(p, q).run();
}

constexpr int kHex = 16;

std::array<std::string, 3> integer_weights(const std::array<mpq_class, 3>& weights) {
  mpz_class denominator = 1;
  for (const mpq_class& w : weights) denominator = lcm(denominator, w.get_den());
  std::array<std::string, 3> out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = mpq_class(weights[k] * denominator).get_num().get_str(kHex);
  return out;
}

// Directions of which one separates two disjoint triangles, if at least one is proper or they are
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

// The gap between the two along a unit direction, from p to q; negative: it does not separate them.
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

// The plane across a normal, where it separates the two: decided exactly.
std::optional<Plane> plane_across(const Vec3& normal, const RationalTriangle& p,
                                  const RationalTriangle& q) {
  const RationalPoint n = to_rational(normal);
  const mpq_class low = std::max({dot(n, p[0]), dot(n, p[1]), dot(n, p[2])});
  const mpq_class high = std::min({dot(n, q[0]), dot(n, q[1]), dot(n, q[2])});
  if (low >= high) return std::nullopt;
  return Plane{{normal.x(), normal.y(), normal.z()}, offset_between(low, high)};
}

// Let x and y be nearest points of two disjoint closed convex sets. No point of the first lies
// further along y - x than x, or moving x towards it would come nearer to y; likewise none of the
// second lies less far than y. So the plane through x across y - x, which is not 0, separates
// strictly whatever the two are: faces, segments or points.
Plane plane_at(const NearestPoints& nearest) {
  const RationalPoint normal = nearest.on_q.at - nearest.on_p.at;
  return {{rational_text(normal[0]), rational_text(normal[1]), rational_text(normal[2])},
          rational_text(dot(normal, nearest.on_p.at))};
}

// Normals n of planes that have two of the vectors on them, or one and that lie within the plane of
// two: among them are all extreme ones of the n with n * p <= 0 <= n * q for all vectors p and q,
// so that the sum of those lies within, off every vector that some n is off.
template <typename Vector, typename Cross, typename Dot, typename Wrong>
Vector sum_of_normals(const std::array<Vector, 2>& p, const std::array<Vector, 2>& q,
                      const Cross& product, const Dot& times, const Wrong& wrong) {
  const std::array<Vector, 4> all = {p[0], p[1], q[0], q[1]};
  std::vector<Vector> normals;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) normals.push_back(product(all[i], all[j]));
  const std::size_t across = normals.size();
  for (std::size_t n = 0; n < across; ++n)
    for (const Vector& v : all) normals.push_back(product(v, normals[n]));
  Vector sum = product(all[0], all[0]);
  for (const Vector& n : normals)
    for (const int sign : {1, -1}) {
      bool weak = true;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto side = times(n, all[i]);
        weak = weak && !wrong(side, (i < 2) == (sign > 0));
      }
      if (!weak) continue;
      for (int k = 0; k < 3; ++k) sum[k] += sign * n[k];
    }
  return sum;
}

// p on its closed side and q on the other, one of them off the plane but for the first corner.
bool parts_at_corner(const RationalPoint& n, const RationalTriangle& p, const RationalTriangle& q) {
  const mpq_class p1 = dot(n, p[1] - p[0]), p2 = dot(n, p[2] - p[0]), q1 = dot(n, q[1] - q[0]),
                  q2 = dot(n, q[2] - q[0]);
  return p1 <= 0 && p2 <= 0 && q1 >= 0 && q2 >= 0 && ((p1 < 0 && p2 < 0) || (q1 > 0 && q2 > 0));
}

}  // namespace

bool is_proper(const TriangleCorners& t) { return Piece(to_rational(t)).proper(); }

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

std::array<Vec3, 2> nearest_points_rounded(const TriangleCorners& p, const TriangleCorners& q) {
  const NearestPoints nearest = nearest_points(to_rational(p), to_rational(q));
  const auto rounded = [](const RationalPoint& x) {
    return Vec3(x[0].get_d(), x[1].get_d(), x[2].get_d());
  };
  return {rounded(nearest.on_p.at), rounded(nearest.on_q.at)};
}

// What two triangles share is the hull of its extreme points, which lie on edges of one of them: in
// the other's face, on its edges or at its corners. The search offers all of these.
std::optional<Witness> further_point(const TriangleCorners& p, const TriangleCorners& q,
                                     std::uint32_t shared) {
  const auto found = Search(to_rational(p), to_rational(q), shared).run();
  if (!found) return std::nullopt;
  return Witness{integer_weights(found->on_p.weights), integer_weights(found->on_q.weights)};
}

bool share_hull_alone(const TriangleCorners& p, const TriangleCorners& q, std::uint32_t shared) {
  const RationalTriangle a = to_rational(p), b = to_rational(q);
  const Piece on_p(a), on_q(b);
  if (on_p.proper() && on_q.proper()) {
    // Off one plane, or in it on two sides of the edge.
    return dot(on_p.normal, b[2] - b[0]) != 0 || dot(on_p.normal, on_q.normal) < 0;
  }
  // A proper triangle meets the line of its edge in the edge alone.
  if (on_p.proper() || on_q.proper()) return true;
  const auto direction = [](const RationalTriangle& t) {
    return t[1] != t[0] ? t[1] - t[0] : t[2] - t[0];
  };
  const RationalPoint u = direction(a), v = direction(b);
  if (u == RationalPoint{} || v == RationalPoint{}) return true;  // a point, which is shared
  if (cross(u, v) != RationalPoint{}) return true;                // two lines
  std::array<mpq_class, 3> s, t;
  for (std::size_t k = 0; k < 3; ++k) {
    s[k] = dot(a[k] - a[0], u);
    t[k] = dot(b[k] - a[0], u);
  }
  const auto [shared_low, shared_high] = std::minmax(s[0], s[shared - 1]);
  const mpq_class low =
      std::max(*std::min_element(s.begin(), s.end()), *std::min_element(t.begin(), t.end()));
  const mpq_class high =
      std::min(*std::max_element(s.begin(), s.end()), *std::max_element(t.begin(), t.end()));
  return low >= shared_low && high <= shared_high;
}

std::optional<Plane> plane_through_corner(const TriangleCorners& p, const TriangleCorners& q) {
  const RationalTriangle a = to_rational(p), b = to_rational(q);
  const auto unit = [&](const Vec3& corner) {
    const Vec3 to = corner - p[0];
    const double size = to.cwiseAbs().maxCoeff();
    return size > 0.0 ? Vec3((to / size).normalized()) : Vec3(Vec3::Zero());
  };
  const std::array<Vec3, 2> near_p = {unit(p[1]), unit(p[2])}, near_q = {unit(q[1]), unit(q[2])};
  const Vec3 guess = sum_of_normals(
      near_p, near_q,
      [](const Vec3& u, const Vec3& v) {
        const Vec3 n = u.cross(v);
        return Vec3(n.norm() > 1e-12 ? n.normalized() : Vec3(Vec3::Zero()));
      },
      [](const Vec3& u, const Vec3& v) { return u.dot(v); },
      [](double side, bool negative) { return (negative ? side : -side) > 1e-9; });
  if (guess.allFinite() && parts_at_corner(to_rational(guess), a, b))
    return Plane{{guess.x(), guess.y(), guess.z()}, rational_text(dot(to_rational(guess), a[0]))};
  const RationalPoint exact = sum_of_normals(
      std::array{a[1] - a[0], a[2] - a[0]}, std::array{b[1] - b[0], b[2] - b[0]},
      [](const RationalPoint& u, const RationalPoint& v) { return cross(u, v); },
      [](const RationalPoint& u, const RationalPoint& v) { return dot(u, v); },
      [](const mpq_class& side, bool negative) { return negative ? side > 0 : side < 0; });
  if (!parts_at_corner(exact, a, b)) return std::nullopt;
  return Plane{{rational_text(exact[0]), rational_text(exact[1]), rational_text(exact[2])},
               rational_text(dot(exact, a[0]))};
}

}  // namespace contactcheck::oracle::certify
