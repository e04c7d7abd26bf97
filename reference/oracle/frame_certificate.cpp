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

// Every offer tells whether the triangles are known to meet: then nothing is nearer.
class Search {
 public:
  Search(const RationalTriangle& p, const RationalTriangle& q) : p_(p), q_(q) {}

  NearestPoints run() {
    // Crossings first: most triangles that meet have one.
    if (!offer_crossings(p_, q_) && !offer_crossings(q_, p_) && !offer_feet(p_, q_) &&
        !offer_feet(q_, p_) && !offer_edges() && !offer_corners(p_, q_))
      offer_corners(q_, p_);
    return std::move(*best_);
  }

 private:
  bool offer(const Piece& first, TrianglePoint a, TrianglePoint b) {
    const RationalPoint apart = b.at - a.at;
    mpq_class squared = oracle::rational::dot(apart, apart);
    if (best_ && best_->squared_distance <= squared) return false;
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
  std::optional<NearestPoints> best_;
};

// Degenerate triangles are the segment or the point that they are. @pre all coordinates finite
NearestPoints nearest_points(const RationalTriangle& p, const RationalTriangle& q) {
  return Search(p, q).run();
}

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
    cover(tree_a().all(), tree_b().all());
  }

 private:
  const RangeTree& tree_a() const { return trees_[pair_.a]; }
  const RangeTree& tree_b() const { return trees_[pair_.b]; }

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

  void decide(const ElementPair& triangles) {
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

FrameCertificate Certifier::certify(const Frame& frame, const std::vector<ElementPair>& touching) {
  for (std::size_t b = 0; b < trees_.size(); ++b) trees_[b].refit(frame.bodies[b].vertices);
  FrameCertificate out;
  PairCertifier certifier(frame, bodies_, trees_, touching, out);
  const auto count = static_cast<std::uint32_t>(bodies_.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) certifier.certify({a, b});
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
