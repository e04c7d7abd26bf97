#include "reference/oracle/frame_certificate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reference/oracle/floating_point.h"
#include "reference/oracle/rational_geometry.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle::certify {
namespace {

// The nearest points of two closed triangles, exactly. For the .cpp files of this layer alone.

using RationalPoint = oracle::rational::Point;

using RationalTriangle = oracle::rational::PointTriple;

using oracle::rational::cross;

using oracle::rational::dot;

using rational::operator-;

using oracle::rational::to_rational;

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
        normal(oracle::rational::cross(triangle[1] - triangle[0], triangle[2] - triangle[0])),
        squared_normal(oracle::rational::dot(normal, normal)) {}

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
  const mpq_class length = oracle::rational::dot(edge, edge);
  if (length == 0) return point_on_edge(piece, k, 0);
  const mpq_class along = oracle::rational::dot(x - piece.corners[k], edge) / length;
  return point_on_edge(piece, k, std::clamp(along, mpq_class(0), mpq_class(1)));
}

// The foot of the perpendicular, where it falls on a proper face.
std::optional<TrianglePoint> foot_on_face(const Piece& piece, const RationalPoint& x) {
  if (!piece.proper()) return std::nullopt;
  std::array<mpq_class, 3> weights;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const mpq_class area = oracle::rational::dot(
        oracle::rational::cross(piece.edge(next), x - piece.corners[next]), piece.normal);
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
    mpq_class squared = oracle::rational::dot(apart, apart);
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
      height[k] = oracle::rational::dot(face.normal, edges.corners[k] - face.corners[0]);
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
    const mpq_class uu = oracle::rational::dot(u, u), uv = oracle::rational::dot(u, v),
                    vv = oracle::rational::dot(v, v);
    const mpq_class det = uu * vv - uv * uv;
    if (det == 0) return false;
    const mpq_class wu = oracle::rational::dot(w, u), wv = oracle::rational::dot(w, v);
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

using oracle::TriangleCorners;

bool is_proper(const TriangleCorners& t) { return Piece(to_rational(t)).proper(); }

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
  const RationalPoint n = oracle::rational::to_rational(normal);
  const mpq_class low = std::max({oracle::rational::dot(n, p[0]), oracle::rational::dot(n, p[1]),
                                  oracle::rational::dot(n, p[2])});
  const mpq_class high = std::min({oracle::rational::dot(n, q[0]), oracle::rational::dot(n, q[1]),
                                   oracle::rational::dot(n, q[2])});
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
          rational_text(oracle::rational::dot(normal, nearest.on_p.at))};
}

}  // namespace

std::optional<Witness> common_point(const TriangleCorners& p, const TriangleCorners& q) {
  const NearestPoints nearest =
      nearest_points(oracle::rational::to_rational(p), oracle::rational::to_rational(q));
  if (nearest.squared_distance != 0) return std::nullopt;
  return Witness{integer_weights(nearest.on_p.weights), integer_weights(nearest.on_q.weights)};
}

std::optional<Plane> separating_plane(const TriangleCorners& p, const TriangleCorners& q) {
  const RationalTriangle a = oracle::rational::to_rational(p), b = oracle::rational::to_rational(q);
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

namespace {

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

RangeTree::RangeTree(const TriangleMesh& rest)
    : triangles_(rest.triangles), boxes_(2 * rest.triangles.size() - 1) {
  const oracle::SurfaceTree tree(rest);
  for (std::uint32_t place = 0; place < triangles_.size(); ++place)
    order_.push_back(tree.triangle_at(place));
}

void RangeTree::refit(std::span<const Vec3> vertices) { refit(all(), vertices); }

const Aabb& RangeTree::refit(const Range& range, std::span<const Vec3> vertices) {
  Aabb box;
  if (range.size() == 1) {
    for (std::uint32_t v : triangles_[order_[range.first]]) box.extend(vertices[v]);
  } else {
    box = refit(range.lower_half(), vertices);
    box.extend(refit(range.upper_half(), vertices));
  }
  return boxes_[range.node] = box;
}

namespace {

using oracle::TriangleCorners;

// An axis along which two closed boxes are disjoint; -1 when they overlap.
int separating_axis(const Aabb& a, const Aabb& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.hi[axis] < b.lo[axis] || b.hi[axis] < a.lo[axis]) return axis;
  return -1;
}

/// One pair of bodies in one frame.
class PairCertifier {
 public:
  PairCertifier(const Frame& frame, const std::vector<Body>& bodies,
                const std::vector<RangeTree>& trees, const std::vector<ElementPair>& touching,
                FrameCertificate& out)
      : frame_(frame), bodies_(bodies), trees_(trees), touching_(touching), out_(out) {}

  void certify(BodyPair pair) {
    pair_ = pair;
    if (pair.a == pair.b) {
      cover_own(tree_a().all());
    } else {
      cover(tree_a().all(), tree_b().all());
    }
  }

 private:
  const RangeTree& tree_a() const { return trees_[pair_.a]; }
  const RangeTree& tree_b() const { return trees_[pair_.b]; }

  void cover_own(const Range& range) {
    if (range.size() == 1) return;
    cover_own(range.lower_half());
    cover_own(range.upper_half());
    cover(range.lower_half(), range.upper_half());
  }

  void cover(const Range& a, const Range& b) {
    const Aabb &box_a = tree_a().box(a), &box_b = tree_b().box(b);
    const int axis = separating_axis(box_a, box_b);
    if (axis >= 0) {
      out_.decisions += "xyz"[axis];
    } else if (a.size() == 1 && b.size() == 1) {
      decide({pair_.a, pair_.b, tree_a().order()[a.first], tree_b().order()[b.first]});
    } else if (b.size() == 1 ||
               (a.size() > 1 && box_a.extent().maxCoeff() >= box_b.extent().maxCoeff())) {
      out_.decisions += 'a';
      cover(a.lower_half(), b);
      cover(a.upper_half(), b);
    } else {
      out_.decisions += 'b';
      cover(a, b.lower_half());
      cover(a, b.upper_half());
    }
  }

  void decide(ElementPair triangles) {
    SharedCorners shared;
    if (pair_.a == pair_.b) {
      if (triangles.a > triangles.b) std::swap(triangles.a, triangles.b);
      const std::vector<Triangle>& linked = bodies_[pair_.a].shape->linked();
      shared = shared_corners(linked[triangles.a], linked[triangles.b]);
    }
    if (shared.duplicates) {
      out_.decisions += 'd';
    } else if (shared.count > 0) {
      decide_neighbours(triangles, shared);
    } else {
      decide_strangers(triangles);
    }
  }

  void decide_neighbours(const ElementPair& triangles, const SharedCorners& shared) {
    const auto arranged = [](const TriangleCorners& t, const std::array<std::uint8_t, 3>& order) {
      return TriangleCorners{t[order[0]], t[order[1]], t[order[2]]};
    };
    const TriangleCorners p = arranged(corners(pair_.a, triangles.a), shared.p),
                          q = arranged(corners(pair_.b, triangles.b), shared.q);
    if (std::binary_search(touching_.begin(), touching_.end(), triangles)) {
      const auto found = further_point(p, q, shared.count);
      if (!found) refuse(triangles, "meet in more than they share");
      Witness witness;
      for (std::size_t k = 0; k < 3; ++k) {
        witness.p[shared.p[k]] = found->p[k];
        witness.q[shared.q[k]] = found->q[k];
      }
      out_.decisions += 't';
      out_.contacts.push_back({triangles, std::move(witness)});
    } else if (shared.count == 2 || (!is_proper(p) && !is_proper(q))) {
      if (!share_hull_alone(p, q, shared.count)) refuse(triangles, "share their vertices alone");
      out_.decisions += 'e';
    } else {
      auto plane = plane_through_corner(p, q);
      if (!plane) refuse(triangles, "share their corner alone");
      out_.decisions += 's';
      out_.gaps.push_back({triangles, std::move(*plane)});
    }
  }

  void decide_strangers(const ElementPair& triangles) {
    const TriangleCorners p = corners(pair_.a, triangles.a), q = corners(pair_.b, triangles.b);
    if (std::binary_search(touching_.begin(), touching_.end(), triangles)) {
      auto witness = common_point(p, q);
      if (!witness) refuse(triangles, "share a point");
      out_.decisions += 't';
      out_.contacts.push_back({triangles, std::move(*witness)});
    } else {
      auto plane = separating_plane(p, q);
      if (!plane) refuse(triangles, "are apart");
      out_.decisions += 's';
      out_.gaps.push_back({triangles, std::move(*plane)});
    }
  }

  TriangleCorners corners(std::uint32_t body, std::uint32_t triangle) const {
    const Triangle& t = bodies_[body].shape->mesh.triangles[triangle];
    const auto vertices = frame_.bodies[body].vertices;
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }

  [[noreturn]] void refuse(const ElementPair& t, const std::string& verdict) const {
    throw std::runtime_error("the oracle says that triangle " + std::to_string(t.a) + " of \"" +
                             bodies_[t.body_a].name + "\" and triangle " + std::to_string(t.b) +
                             " of \"" + bodies_[t.body_b].name + "\" " + verdict + " in frame " +
                             std::to_string(frame_.index) + ", which is not so");
  }

  const Frame& frame_;
  const std::vector<Body>& bodies_;
  const std::vector<RangeTree>& trees_;
  const std::vector<ElementPair>& touching_;
  FrameCertificate& out_;
  BodyPair pair_;
};

template <typename Certified>
void sort_by_triangles(std::vector<Certified>& certified) {
  std::sort(certified.begin(), certified.end(),
            [](const Certified& x, const Certified& y) { return x.triangles < y.triangles; });
}

}  // namespace

Certifier::Certifier(const std::vector<Body>& bodies) : bodies_(bodies) {
  for (const Body& body : bodies) trees_.emplace_back(body.shape->mesh);
}

FrameCertificate Certifier::certify(const Frame& frame, const std::vector<ElementPair>& between,
                                    const std::vector<SelfPair>* own) {
  std::vector<ElementPair> touching = between;
  if (own != nullptr)
    for (const SelfPair& pair : *own) touching.push_back({pair.body, pair.body, pair.a, pair.b});
  std::sort(touching.begin(), touching.end());
  for (std::size_t b = 0; b < trees_.size(); ++b) trees_[b].refit(frame.bodies[b].vertices);
  FrameCertificate out;
  PairCertifier certifier(frame, bodies_, trees_, touching, out);
  const auto count = static_cast<std::uint32_t>(bodies_.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) certifier.certify({a, b});
  for (std::uint32_t a = 0; own != nullptr && a < count; ++a) certifier.certify({a, a});
  // Every contact was told as one, so that equal numbers mean equal sets.
  if (out.contacts.size() != touching.size())
    throw std::runtime_error("the oracle reports " + std::to_string(touching.size()) +
                             " pairs of triangles in frame " + std::to_string(frame.index) +
                             ", and only " + std::to_string(out.contacts.size()) +
                             " have boxes that meet");
  sort_by_triangles(out.contacts);
  sort_by_triangles(out.gaps);
  return out;
}

}  // namespace contactcheck::oracle::certify
