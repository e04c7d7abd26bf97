// Branch and bound. Let f(x) be the distance of x to the surface of a solid where x is inside it,
// and minus that distance elsewhere: f changes by no more than x moves. The depth is the maximum
// of f over the other surface. Boxes of its tree, then its triangles, then pieces of these wait in
// the order of their upper bounds; the highest is split. Points of pieces that are exactly inside
// give lower bounds. What is certainly outside is cut.
//
// Upper bounds of f over a piece with corners c_i:
// 1. f(c) + r, if all of the piece is within r of c. Near a maximum of f, alone, it would need
//    pieces as small as the width that is wanted.
// 2. Let T be a triangle with corners t_i without a point strictly inside the solid. The point
//    p = sum w_i c_i of the piece has the partner sum w_i t_i on T, at most sum w_i |c_i - t_i|
//    away. If p is inside, a segment that ends at no inner point leaves the solid on the way, so
//    f(p) <= sum w_i |c_i - t_i|: a bound linear in w.
//    a. T within a triangle of the surface: |c_i - t_i| are distances to that triangle.
//    b. T parallel to the tangent plane at a nearest point, a little above it, or to the piece;
//       shown to be outside by exact tests. One such T spans many triangles of a divided face.
//    Several bounds u_k hold at once: f <= min_k sum_i w_i u_ki <= max_i sum_k l_k u_ki for any
//    weights l_k >= 0 of sum 1. Good weights make the bound tight on ridges of f, where two sides
//    of the solid are as near.
//
// Rounding, with e = 2^-53 and |coordinates| <= 1. The middle of two points is off by at most e / 2
// per coordinate, by less than e in length; each level of splitting adds that, so a piece of level
// n lies within n e of the part of the triangle that it stands for (corners do, so their weighted
// sums do). Lengths of differences and sums of three products have relative errors below 16 e,
// weights of sum 1 likewise; underflow is below 2^-500, which kUnderflow pays for. It also pays for
// bits that scaling lost below 2^-1074: surfaces so near the true ones wind alike round every point
// that is farther from them.
#include "reference/oracle/surface_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/vertex_distance.h"
#include "reference/oracle/vertex_queries.h"

namespace contactcheck::oracle {
namespace {

constexpr double kMiddleRounding = 0x1p-53;  // in length, per level
constexpr double kOutward = 1 + 0x1p-49;
constexpr double kUnderflow = 0x1p-480;

// Widths that end the search, of the upper end and of the coordinates (from 0.5 to 1).
constexpr double kRelativeDepthWidth = 1e-3, kDepthWidth = 4e-10;
// How far above the tangent plane triangles of kind b are, first: over flat faces that is enough.
// Then a share of the largest height is added, for rough ones. Smaller: rough faces pierce them;
// larger: wider intervals.
constexpr double kLeastLift = 0x1p-34, kRoughLift = 1e-4;
// Triangles tested against one of kind b; a piece that meets more boxes is split instead.
constexpr int kMostLiftTests = 64;
// Bounds of a distance that are wider than this share of it, or of the coordinates, are computed in
// rational arithmetic.
constexpr double kLooseShare = 1e-5, kLooseWidth = 1e-11;

double up(double x) { return x * kOutward + kUnderflow; }

double length_up(const Vec3& v) { return up(v.norm()); }

// Zero if rounding makes it too small.
Vec3 unit_normal(const TriangleCorners& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double length = normal.norm();
  return length > 0x1p-400 ? Vec3(normal / length) : Vec3::Zero();
}

// The rounded centroid of three points is off by less than so many middles are.
constexpr int kCentroidLevels = 4;

/// A point, how far it is from a solid's surface, and where.
struct Probe {
  Vec3 point;
  Vec3 offset = Vec3::Zero();  ///< to the nearest point, up to rounding
  double lower = 0.0, upper = 0.0;
  std::uint32_t triangle = 0;  ///< nearest
  bool inside = false;         ///< strictly; exact
};

/// An upper bound of f within `radius` of the point; not above 0 only if nothing there is inside.
double highest_near(const Probe& p, double radius) {
  return p.inside ? up(p.upper + radius) : radius - p.lower > 0 ? up(radius - p.lower) : 0.0;
}

/// Certainly, with a margin for the rounding of points of pieces within.
bool all_inside(const Probe& p, double radius) { return p.inside && p.lower > radius + kLeastLift; }

/// Part of a triangle of one surface.
struct TrianglePiece {
  double upper;
  std::array<Probe, 3> corners;
  std::uint8_t side;   ///< whose surface: 0 or 1
  std::uint8_t level;  ///< of splitting
  bool inside;         ///< certainly all of it
};

/// A box of the tree of one surface.
struct TriangleGroup {
  double upper;
  std::uint32_t node;
  std::uint8_t side;
  bool inside;
};

constexpr auto kHighestLast = [](const auto& x, const auto& y) { return x.upper < y.upper; };

/// The distance of a point to a surface.
class NearestSearch {
 public:
  NearestSearch(const SurfaceTree& surface, Probe& probe) : surface_(surface), probe_(probe) {
    probe_.lower = probe_.upper = std::numeric_limits<double>::infinity();
    descend(0);
  }

 private:
  bool worth(const Aabb& box) const { return distance_to(box, probe_.point) <= probe_.upper; }

  void descend(std::uint32_t index) {
    const SurfaceTree::Node& node = surface_.node(index);
    if (!worth(node.box)) return;
    if (node.is_leaf()) {
      for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
        if (worth(surface_.box_at(place))) measure(surface_.triangle_at(place));
      return;
    }
    std::uint32_t first = index + 1, second = node.second;
    if (distance_to(surface_.node(second).box, probe_.point) <
        distance_to(surface_.node(first).box, probe_.point))
      std::swap(first, second);
    descend(first);
    descend(second);
  }

  void measure(std::uint32_t triangle) {
    const TriangleCorners corners = surface_.corners(triangle);
    NearestPoint near = nearest_point(probe_.point, corners);
    if (near.lower > probe_.upper) return;
    const bool tight = near.upper - near.lower <= kLooseShare * near.upper + kLooseWidth;
    if (!tight || !std::isfinite(near.upper)) near = exact_nearest_point(probe_.point, corners);
    probe_.lower = std::min(probe_.lower, near.lower);
    if (!(near.upper < probe_.upper)) return;
    probe_.upper = near.upper;
    probe_.offset = near.offset;
    probe_.triangle = triangle;
  }

  const SurfaceTree& surface_;
  Probe& probe_;
};

/// Bounds linear on a piece, by their values at its corners.
class LinearBounds {
 public:
  using Values = std::array<double, 3>;

  /// The lowest upper bound of their minimum that weights of one, two or three of them give.
  double highest() const { return best_; }

  void add(const Values& values) {
    best_ = std::min(best_, best_with(values));
    bounds_.push_back(values);
  }
  /// What highest() would be with one more.
  double highest_with(const Values& values) const { return std::min(best_, best_with(values)); }

 private:
  static double weighted(const Values& a, double s, const Values& b, double r, const Values& c,
                         double q) {
    double out = 0.0;
    for (int i = 0; i < 3; ++i) out = std::max(out, s * a[i] + r * b[i] + q * c[i]);
    return up(out);
  }

  // Between two bounds the best weights are at an end or make two corners equal.
  static double best_of_two(const Values& a, const Values& b) {
    double out = std::min(weighted(a, 1, b, 0, b, 0), weighted(b, 1, a, 0, a, 0));
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double at_a = a[i] - a[j], at_b = b[i] - b[j], s = at_b / (at_b - at_a);
      if (s > 0 && s < 1) out = std::min(out, weighted(a, s, b, 1 - s, b, 0));
    }
    return out;
  }

  // For three bounds: the weights that make all corners equal, if none of them is negative.
  static double best_of_three(const Values& a, const Values& b, const Values& c) {
    const double a1 = a[0] - a[1], b1 = b[0] - b[1], c1 = c[0] - c[1];
    const double a2 = a[0] - a[2], b2 = b[0] - b[2], c2 = c[0] - c[2];
    const double s = b1 * c2 - c1 * b2, r = c1 * a2 - a1 * c2, q = a1 * b2 - b1 * a2;
    const double sum = s + r + q;
    if (!(s / sum >= 0 && r / sum >= 0 && q / sum >= 0))
      return std::numeric_limits<double>::infinity();
    return weighted(a, s / sum, b, r / sum, c, q / sum);
  }

  double best_with(const Values& values) const {
    double out = weighted(values, 1, values, 0, values, 0);
    for (std::size_t k = 0; k < bounds_.size(); ++k) {
      out = std::min(out, best_of_two(bounds_[k], values));
      for (std::size_t l = 0; l < k; ++l)
        out = std::min(out, best_of_three(bounds_[l], bounds_[k], values));
    }
    return out;
  }

  std::vector<Values> bounds_;
  double best_ = std::numeric_limits<double>::infinity();
};

class DepthSearch {
 public:
  DepthSearch(const SurfaceTree& a, const SurfaceTree& b, const DepthWanted& wanted)
      : trees_{&a, &b}, wanted_(wanted) {}

  DistanceBounds run();

 private:
  const SurfaceTree& surface_of(std::uint8_t side) const { return *trees_[side]; }
  const SurfaceTree& solid_for(std::uint8_t side) const { return *trees_[1 - side]; }

  double upper() const;
  bool narrow_enough() const;
  Probe probe(std::uint8_t side, const Vec3& point, bool inside) const;
  void offer(const Probe& probe, int level);
  void add_group(TriangleGroup group);
  void add_triangle(const TriangleGroup& of, std::uint32_t triangle);
  void add_piece(TrianglePiece piece);
  void split(const TriangleGroup& group);
  void split(const TrianglePiece& piece);
  double linear_bound(const TrianglePiece& piece, const Probe& center) const;
  void add_tangents(const TrianglePiece& piece, const Probe& at, LinearBounds& bounds) const;
  void add_above(const TrianglePiece& piece, const Vec3& base, const Vec3& normal,
                 LinearBounds& bounds) const;
  bool outside(const SurfaceTree& solid, const TriangleCorners& t) const;

  std::array<const SurfaceTree*, 2> trees_;
  DepthWanted wanted_;
  double lower_ = 0.0;
  std::vector<TriangleGroup> groups_;  // heaps
  std::vector<TrianglePiece> pieces_;
};

double DepthSearch::upper() const {
  double out = lower_;
  if (!groups_.empty()) out = std::max(out, groups_.front().upper);
  if (!pieces_.empty()) out = std::max(out, pieces_.front().upper);
  return out;
}

bool DepthSearch::narrow_enough() const {
  const double high = upper();
  if (high <= wanted_.limit || high - lower_ <= kDepthWidth) return true;
  return high - lower_ <= kRelativeDepthWidth * high && lower_ > wanted_.limit;
}

DistanceBounds DepthSearch::run() {
  for (const std::uint8_t side : {0, 1})
    add_group({std::numeric_limits<double>::infinity(), 0, side, false});
  int splits = 0;
  while (!narrow_enough() && splits < wanted_.pieces) {
    ++splits;
    if (pieces_.empty() || (!groups_.empty() && groups_.front().upper >= pieces_.front().upper)) {
      std::pop_heap(groups_.begin(), groups_.end(), kHighestLast);
      const TriangleGroup group = groups_.back();
      groups_.pop_back();
      split(group);
    } else {
      std::pop_heap(pieces_.begin(), pieces_.end(), kHighestLast);
      const TrianglePiece piece = pieces_.back();
      pieces_.pop_back();
      split(piece);
    }
  }
  return {lower_, upper()};
}

// @param inside  the caller already found the point inside; else this function tests it
Probe DepthSearch::probe(std::uint8_t side, const Vec3& point, bool inside) const {
  Probe out;
  out.point = point;
  NearestSearch(solid_for(side), out);
  out.inside = inside || strictly_inside(solid_for(side), point);
  return out;
}

// A point of the surface, up to the rounding of its level.
void DepthSearch::offer(const Probe& probe, int level) {
  if (probe.inside) lower_ = std::max(lower_, probe.lower - level * kMiddleRounding - kUnderflow);
}

// A part has the bound of the whole until it has a lower one.
void DepthSearch::add_group(TriangleGroup group) {
  const Aabb& box = surface_of(group.side).node(group.node).box;
  if (!box.overlaps(solid_for(group.side).bounds())) return;
  const Probe center = probe(group.side, box.center(), group.inside);
  const double radius = length_up((box.hi - center.point).cwiseMax(center.point - box.lo));
  group.upper = std::min(group.upper, highest_near(center, radius));
  if (group.upper <= lower_) return;
  group.inside = all_inside(center, radius);
  groups_.push_back(group);
  std::push_heap(groups_.begin(), groups_.end(), kHighestLast);
}

void DepthSearch::split(const TriangleGroup& group) {
  const SurfaceTree& surface = surface_of(group.side);
  const SurfaceTree::Node& node = surface.node(group.node);
  if (!node.is_leaf()) {
    for (const std::uint32_t child : {group.node + 1, node.second})
      add_group({group.upper, child, group.side, group.inside});
    return;
  }
  for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
    if (surface.box_at(place).overlaps(solid_for(group.side).bounds()))
      add_triangle(group, surface.triangle_at(place));
}

void DepthSearch::add_triangle(const TriangleGroup& of, std::uint32_t triangle) {
  TrianglePiece piece{of.upper, {}, of.side, 0, of.inside};
  const TriangleCorners corners = surface_of(of.side).corners(triangle);
  for (int i = 0; i < 3; ++i) {
    piece.corners[i] = probe(of.side, corners[i], of.inside);
    offer(piece.corners[i], 0);
  }
  add_piece(std::move(piece));
}

// Halves the longest side.
void DepthSearch::split(const TrianglePiece& piece) {
  std::array<double, 3> sides;
  for (int i = 0; i < 3; ++i)
    sides[i] = (piece.corners[i].point - piece.corners[(i + 1) % 3].point).squaredNorm();
  const auto i = std::max_element(sides.begin(), sides.end()) - sides.begin(), j = (i + 1) % 3;
  const Vec3 middle = (piece.corners[i].point + piece.corners[j].point) / 2;
  const Probe at_middle = probe(piece.side, middle, piece.inside);
  for (const auto replaced : {i, j}) {
    TrianglePiece half = piece;
    half.corners[replaced] = at_middle;
    ++half.level;
    if (replaced == i) offer(at_middle, half.level);
    add_piece(std::move(half));
  }
}

void DepthSearch::add_piece(TrianglePiece piece) {
  const std::array<Probe, 3>& c = piece.corners;
  const double rounding = piece.level * kMiddleRounding;
  const Vec3 middle = (c[0].point + c[1].point + c[2].point) / 3;
  const Probe center = probe(piece.side, middle, piece.inside);
  double radius = 0.0;
  for (const Probe& corner : c) radius = std::max(radius, length_up(corner.point - middle));
  radius = up(radius + rounding);
  piece.inside = all_inside(center, radius);
  offer(center, piece.level + kCentroidLevels);
  piece.upper = std::min(piece.upper, highest_near(center, radius));
  if (piece.upper > lower_)
    piece.upper = std::min(piece.upper, up(linear_bound(piece, center) + rounding));
  if (piece.upper <= lower_) return;
  pieces_.push_back(std::move(piece));
  std::push_heap(pieces_.begin(), pieces_.end(), kHighestLast);
}

double DepthSearch::linear_bound(const TrianglePiece& piece, const Probe& center) const {
  const SurfaceTree& solid = solid_for(piece.side);
  LinearBounds bounds;
  const std::array<const Probe*, 4> probes = {&center, &piece.corners[0], &piece.corners[1],
                                              &piece.corners[2]};
  std::array<std::uint32_t, 4> seen;
  for (std::size_t k = 0; k < probes.size(); ++k) {
    const auto end = seen.begin() + k;
    seen[k] = probes[k]->triangle;
    if (std::find(seen.begin(), end, seen[k]) != end) continue;
    const TriangleCorners corners = solid.corners(seen[k]);
    LinearBounds::Values values;
    for (int i = 0; i < 3; ++i) values[i] = nearest_point(piece.corners[i].point, corners).upper;
    // A triangle that is too small to be measured has no upper bound.
    if (std::isfinite(values[0] + values[1] + values[2])) bounds.add(values);
  }
  for (const Probe* at : probes) {
    if (bounds.highest() <= lower_) break;
    add_tangents(piece, *at, bounds);
  }
  // Off along its own normal, for a face that an edge of the solid touches or pierces no deeper
  // than is known.
  const Vec3 normal =
      unit_normal({piece.corners[0].point, piece.corners[1].point, piece.corners[2].point});
  for (const double height : {0.0, lower_})
    for (const Vec3& way : {normal, Vec3(-normal)})
      if (bounds.highest() > lower_) add_above(piece, center.point + height * way, way, bounds);
  return bounds.highest();
}

// Normals point outward where the side is known; on the surface either direction may be.
void DepthSearch::add_tangents(const TrianglePiece& piece, const Probe& at,
                               LinearBounds& bounds) const {
  const Vec3 base = at.point + at.offset;
  const double length = at.offset.norm();
  if (length > kLeastLift)
    return add_above(piece, base, at.offset * ((at.inside ? 1 : -1) / length), bounds);
  const Vec3 normal = unit_normal(solid_for(piece.side).corners(at.triangle));
  for (const Vec3& way : {normal, Vec3(-normal)}) add_above(piece, base, way, bounds);
}

void DepthSearch::add_above(const TrianglePiece& piece, const Vec3& base, const Vec3& normal,
                            LinearBounds& bounds) const {
  LinearBounds::Values heights, values;
  for (int i = 0; i < 3; ++i) heights[i] = normal.dot(base - piece.corners[i].point);
  const double highest = std::max(0.0, *std::max_element(heights.begin(), heights.end()));
  for (const double lift : {kLeastLift, kLeastLift + kRoughLift * highest}) {
    TriangleCorners above;
    for (int i = 0; i < 3; ++i) {
      above[i] = piece.corners[i].point + normal * std::max(0.0, heights[i] + lift);
      values[i] = length_up(above[i] - piece.corners[i].point);
    }
    if (bounds.highest_with(values) >= bounds.highest()) return;
    if (outside(solid_for(piece.side), above)) return bounds.add(values);
  }
}

bool DepthSearch::outside(const SurfaceTree& solid, const TriangleCorners& t) const {
  Aabb box;
  for (const Vec3& corner : t) box.extend(corner);
  int tests = 0;
  const bool meets = any_triangle(
      solid, [&](const Aabb& other) { return other.overlaps(box); },
      [&](std::uint32_t triangle) {
        return ++tests > kMostLiftTests || triangles_intersect(solid.corners(triangle), t);
      });
  return !meets && !strictly_inside(solid, t[0]);
}

}  // namespace

DistanceBounds surface_depth(const SurfaceTree& a, const SurfaceTree& b,
                             const DepthWanted& wanted) {
  return DepthSearch(a, b, wanted).run();
}

}  // namespace contactcheck::oracle
