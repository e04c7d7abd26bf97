#include "reference/oracle/rational_geometry.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace contactcheck::oracle::rational {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Phase one: each row starts with an artificial unknown of its own, and the sum of the artificial
/// ones is driven down. Only the real unknowns have columns: an artificial one that left the basis
/// never comes back.
class PhaseOne {
 public:
  explicit PhaseOne(std::vector<Equation> rows) : rows_(std::move(rows)) {
    unknowns_ = rows_.front().coefficients.size();
    goal_.coefficients.resize(unknowns_);
    for (Equation& row : rows_) {
      if (row.right < 0) negate(row);
      subtract(goal_, row, mpq_class(-1));
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) basis_.push_back(unknowns_ + i);
  }

  bool solve() {
    for (;;) {
      if (goal_.right == 0) return true;
      const std::size_t column = entering_column();
      if (column == kNone) return false;
      pivot(leaving_row(column), column);
    }
  }

 private:
  static void negate(Equation& row) {
    for (mpq_class& value : row.coefficients) value = -value;
    row.right = -row.right;
  }

  /// row -= factor * other
  static void subtract(Equation& row, const Equation& other, const mpq_class& factor) {
    for (std::size_t i = 0; i < row.coefficients.size(); ++i)
      if (other.coefficients[i] != 0) row.coefficients[i] -= factor * other.coefficients[i];
    row.right -= factor * other.right;
  }

  /// Bland: the first column that lowers the sum of the artificial unknowns.
  std::size_t entering_column() const {
    for (std::size_t i = 0; i < unknowns_; ++i)
      if (goal_.coefficients[i] > 0) return i;
    return kNone;
  }

  /// Bland: the smallest ratio, and among equal ones the lowest unknown. There is one, because the
  /// goal is bounded by zero.
  std::size_t leaving_row(std::size_t column) const {
    std::size_t best = kNone;
    mpq_class best_ratio;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].coefficients[column] <= 0) continue;
      const mpq_class ratio = rows_[i].right / rows_[i].coefficients[column];
      const bool better =
          best == kNone || ratio < best_ratio || (ratio == best_ratio && basis_[i] < basis_[best]);
      if (!better) continue;
      best = i;
      best_ratio = ratio;
    }
    return best;
  }

  void pivot(std::size_t pivot_row, std::size_t column) {
    Equation& row = rows_[pivot_row];
    const mpq_class scale = row.coefficients[column];
    for (mpq_class& value : row.coefficients) value /= scale;
    row.right /= scale;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const mpq_class factor = rows_[i].coefficients[column];
      if (i != pivot_row && factor != 0) subtract(rows_[i], row, factor);
    }
    const mpq_class factor = goal_.coefficients[column];
    subtract(goal_, row, factor);
    basis_[pivot_row] = column;
  }

  std::vector<Equation> rows_;
  Equation goal_;  ///< the sum of the artificial unknowns, in the non-basic unknowns
  std::vector<std::size_t> basis_;
  std::size_t unknowns_ = 0;
};

}  // namespace

bool has_nonnegative_solution(std::vector<Equation> equations) {
  return PhaseOne(std::move(equations)).solve();
}

namespace {

using Triangle = PointTriple;

/// point + factor * direction
Point along(const Point& point, const mpq_class& factor, const Point& direction) {
  return {point[0] + factor * direction[0], point[1] + factor * direction[1],
          point[2] + factor * direction[2]};
}

mpq_class squared_distance(const Point& a, const Point& b) {
  const Point difference = a - b;
  return dot(difference, difference);
}

/// The foot of the perpendicular from p on the line, where it falls on the segment ab.
std::optional<Point> foot_on_segment(const Point& p, const Point& a, const Point& b) {
  const Point edge = b - a;
  const mpq_class length = dot(edge, edge);
  if (length == 0) return std::nullopt;
  const mpq_class s = dot(p - a, edge) / length;
  if (s < 0 || s > 1) return std::nullopt;
  return along(a, s, edge);
}

/// The foot of the perpendicular from p on the plane, where it falls on the triangle.
std::optional<Point> foot_on_triangle(const Point& p, const Triangle& t) {
  const Point u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const mpq_class uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const mpq_class gram = uu * vv - uv * uv;
  if (gram == 0) return std::nullopt;
  const mpq_class r = (vv * uw - uv * vw) / gram, s = (uu * vw - uv * uw) / gram;
  if (r < 0 || s < 0 || r + s > 1) return std::nullopt;
  return along(along(t[0], r, u), s, v);
}

/// Squared distance of the two lines, where the closest points fall on the segments.
std::optional<mpq_class> between_segments(const Point& a, const Point& b, const Point& c,
                                          const Point& d) {
  const Point u = b - a, v = d - c, w = c - a;
  const mpq_class uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const mpq_class gram = uu * vv - uv * uv;
  if (gram == 0) return std::nullopt;
  const mpq_class s = (vv * uw - uv * vw) / gram, r = (uv * uw - uu * vw) / gram;
  if (s < 0 || s > 1 || r < 0 || r > 1) return std::nullopt;
  return squared_distance(along(a, s, u), along(c, r, v));
}

void lower(mpq_class& best, const mpq_class& candidate) {
  if (candidate < best) best = candidate;
}

/// Corners of p against corners, edges and face of q.
void lower_by_corners(mpq_class& best, const Triangle& p, const Triangle& q) {
  for (const Point& corner : p) {
    for (std::size_t i = 0; i < 3; ++i) {
      lower(best, squared_distance(corner, q[i]));
      if (const auto foot = foot_on_segment(corner, q[i], q[(i + 1) % 3]))
        lower(best, squared_distance(corner, *foot));
    }
    if (const auto foot = foot_on_triangle(corner, q)) lower(best, squared_distance(corner, *foot));
  }
}

void lower_by_edges(mpq_class& best, const Triangle& p, const Triangle& q) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (const auto d = between_segments(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]))
        lower(best, *d);
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Point origin = to_rational(a);
  const Point u = to_rational(b) - origin, v = to_rational(c) - origin;
  return sgn(dot(cross(u, v), to_rational(d) - origin));
}

int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const Point origin = to_rational(a);
  const Point normal = cross(to_rational(b) - origin, to_rational(c) - origin);
  return sgn(normal[static_cast<std::size_t>(axis)]);
}

bool triangles_intersect(const TriangleCorners& p, const TriangleCorners& q) {
  // Six barycentric coordinates >= 0: sum p_i x_i = sum q_j y_j, sum x_i = 1, sum y_j = 1.
  const Triangle rp = to_rational(p), rq = to_rational(q);
  std::vector<Equation> equations;
  for (std::size_t axis = 0; axis < 3; ++axis)
    equations.push_back({{rp[0][axis], rp[1][axis], rp[2][axis], mpq_class(-rq[0][axis]),
                          mpq_class(-rq[1][axis]), mpq_class(-rq[2][axis])},
                         0});
  equations.push_back({{1, 1, 1, 0, 0, 0}, 1});
  equations.push_back({{0, 0, 0, 1, 1, 1}, 1});
  return has_nonnegative_solution(std::move(equations));
}

bool triangle_meets_box(const TriangleCorners& triangle, const Aabb& box) {
  if (box.empty()) return false;
  // Three barycentric coordinates, and per axis the distances from both faces, all >= 0:
  // sum p_i x_i - below = lo, sum p_i x_i + above = hi, sum x_i = 1.
  const Triangle t = to_rational(triangle);
  std::vector<Equation> equations;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<mpq_class> row(9);
      for (std::size_t i = 0; i < 3; ++i) row[i] = t[i][axis];
      row[3 + 2 * axis + side] = side == 0 ? -1 : 1;
      const Vec3& bound = side == 0 ? box.lo : box.hi;
      equations.push_back({std::move(row), mpq_class(bound[static_cast<int>(axis)])});
    }
  }
  equations.push_back({{1, 1, 1, 0, 0, 0, 0, 0, 0}, 1});
  return has_nonnegative_solution(std::move(equations));
}

mpq_class squared_distance(const TriangleCorners& p, const TriangleCorners& q) {
  if (triangles_intersect(p, q)) return 0;
  // The closest points of two disjoint triangles lie on a corner and a face, edge or corner, or on
  // two edges: the smallest over all those pairs is the distance, degenerate triangles included.
  const Triangle rp = to_rational(p), rq = to_rational(q);
  mpq_class best = squared_distance(rp[0], rq[0]);
  lower_by_corners(best, rp, rq);
  lower_by_corners(best, rq, rp);
  lower_by_edges(best, rp, rq);
  return best;
}

}  // namespace contactcheck::oracle::rational
