// Why the search below misses nothing. Take nearest points x and y and the smallest corners, edges
// or faces that hold them. If the triangles meet where an edge passes from one side of a proper
// face to the other, offer_crossings finds that point. Otherwise move x and y together along a
// direction that is free in both pieces: two faces, or an edge and a face, with x and y inside them
// have one (they are parallel, or the triangles would cross), along which the distance cannot
// change, until one of the two points comes to the border of its piece. What remains is a corner
// with a face, a corner with an edge or corner, and two edges that are not parallel. All of those
// are tried. A degenerate triangle has no face; its edges cover it.
#include "reference/certify/nearest_points.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace contactcheck::certify {
namespace {

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
    mpq_class squared = dot(apart, apart);
    if (best_ && best_->squared_distance <= squared) return false;
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
  std::optional<NearestPoints> best_;
};

}  // namespace

NearestPoints nearest_points(const RationalTriangle& p, const RationalTriangle& q) {
  return Search(p, q).run();
}

}  // namespace contactcheck::certify
