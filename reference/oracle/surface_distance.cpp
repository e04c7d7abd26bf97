// Branch and bound over two box trees. Every pair of triangles that could be nearest is given
// certified bounds in double; pairs that no slab separates are tested exactly. The minimum of the
// lower and the minimum of the upper bounds hold the truth between them; where that is too wide,
// the pairs with the lowest lower bounds are measured in rational arithmetic until it is not.
//
// All arithmetic runs on coordinates scaled by a power of two to at most 1: squares neither
// overflow nor underflow, and rounding has absolute bounds. Scaling is exact, but for bits below
// 2^-1074 of the largest coordinate, which exact tests, made on the unscaled values, still see.
#include "reference/oracle/surface_distance.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/triangle_distance.h"

namespace contactcheck::oracle {
namespace {

// Promised is 1e-9 of the largest |coordinate|, which scaling brings to at least 0.5. The rest
// pays for the final rounding. Smaller: more rational arithmetic.
constexpr double kWidth = 4e-10;
// The computed squared distance of two boxes exceeds the true one by less than 5 * 2^-53 of it.
constexpr double kSquaredGapRounding = 1 - 16 * 0x1p-53;

void scale(ScaledSurface& surface, int exponent) {
  surface.scaled.clear();
  surface.scaled.reserve(surface.vertices.size());
  for (const Vec3& p : surface.vertices) surface.scaled.push_back(scaled_by_two_to(exponent, p));
  surface.tree->refit(surface.scaled);
}

// A lower bound of the squared distance of any two points of the boxes.
double squared_gap(const Aabb& a, const Aabb& b) {
  const Vec3 gap = (a.lo - b.hi).cwiseMax(b.lo - a.hi).cwiseMax(0.0);
  return gap.squaredNorm() * kSquaredGapRounding;
}

struct PairBounds {
  std::uint32_t a, b;
  DistanceBounds bounds;
};

bool lower_last(const PairBounds& x, const PairBounds& y) {
  return x.bounds.lower > y.bounds.lower;
}

class DistanceSearch {
 public:
  DistanceSearch(const ScaledSurface& a, const ScaledSurface& b) : a_(a), b_(b) {}

  DistanceBounds run() {
    descend(0, 0);
    if (touching_) return {0.0, 0.0};
    return refine();
  }

  /// The triangles that touch, or whose distance gave the upper bound.
  const std::array<std::uint32_t, 2>& nearest() const { return nearest_; }

 private:
  const SurfaceTree& tree_a() const { return *a_.tree; }
  const SurfaceTree& tree_b() const { return *b_.tree; }

  // Not farther than the best upper bound, which holds its rounding, so its square does not
  // underflow.
  bool worth(double squared) const { return squared <= upper_ * upper_; }

  void descend(std::uint32_t i, std::uint32_t j);
  void descend_nearer_first(std::uint32_t i1, std::uint32_t j1, std::uint32_t i2, std::uint32_t j2);
  void measure_leaves(const SurfaceTree::Node& x, const SurfaceTree::Node& y);
  void measure(std::uint32_t a, std::uint32_t b);
  DistanceBounds refine();

  void offer(std::uint32_t a, std::uint32_t b, double upper) {
    if (!(upper < upper_)) return;
    upper_ = upper;
    nearest_ = {a, b};
  }

  const ScaledSurface& a_;
  const ScaledSurface& b_;
  double upper_ = std::numeric_limits<double>::infinity();
  bool touching_ = false;
  std::array<std::uint32_t, 2> nearest_{};
  std::vector<PairBounds> near_;  // all pairs measured whose lower bound was not above upper_
};

void DistanceSearch::descend(std::uint32_t i, std::uint32_t j) {
  const SurfaceTree::Node& x = tree_a().node(i);
  const SurfaceTree::Node& y = tree_b().node(j);
  if (touching_ || !worth(squared_gap(x.box, y.box))) return;
  if (x.is_leaf() && y.is_leaf()) return measure_leaves(x, y);
  const bool split_a =
      y.is_leaf() || (!x.is_leaf() && x.box.extent().maxCoeff() >= y.box.extent().maxCoeff());
  if (split_a) {
    descend_nearer_first(i + 1, j, x.second, j);
  } else {
    descend_nearer_first(i, j + 1, i, y.second);
  }
}

void DistanceSearch::descend_nearer_first(std::uint32_t i1, std::uint32_t j1, std::uint32_t i2,
                                          std::uint32_t j2) {
  // Overlapping boxes are all at distance 0: then the centres tell which is likelier to be near.
  const auto key = [&](std::uint32_t i, std::uint32_t j) {
    const Aabb& x = tree_a().node(i).box;
    const Aabb& y = tree_b().node(j).box;
    return std::pair(squared_gap(x, y), (x.center() - y.center()).squaredNorm());
  };
  if (key(i2, j2) < key(i1, j1)) {
    std::swap(i1, i2);
    std::swap(j1, j2);
  }
  descend(i1, j1);
  descend(i2, j2);
}

void DistanceSearch::measure_leaves(const SurfaceTree::Node& x, const SurfaceTree::Node& y) {
  for (std::uint32_t i = x.first; i < x.first + x.count; ++i) {
    const Aabb& box = tree_a().box_at(i);
    if (!worth(squared_gap(box, y.box))) continue;
    for (std::uint32_t j = y.first; j < y.first + y.count && !touching_; ++j)
      if (worth(squared_gap(box, tree_b().box_at(j))))
        measure(tree_a().triangle_at(i), tree_b().triangle_at(j));
  }
}

void DistanceSearch::measure(std::uint32_t a, std::uint32_t b) {
  const TriangleCorners p = tree_a().corners(a), q = tree_b().corners(b);
  if (slab_bound(p, q) > upper_) return;
  const DistanceBounds bounds = distance_bounds(p, q);
  if (bounds.lower > upper_) return;
  if (bounds.lower == 0 &&
      triangles_intersect(tree_a().corners(a, a_.vertices), tree_b().corners(b, b_.vertices))) {
    touching_ = true;
    nearest_ = {a, b};
    return;
  }
  offer(a, b, bounds.upper);
  near_.push_back({a, b, bounds});
}

DistanceBounds DistanceSearch::refine() {
  std::erase_if(near_, [&](const PairBounds& pair) { return pair.bounds.lower > upper_; });
  std::make_heap(near_.begin(), near_.end(), lower_last);
  double lowest_refined = std::numeric_limits<double>::infinity();
  while (!near_.empty()) {
    const PairBounds pair = near_.front();
    if (upper_ - pair.bounds.lower <= kWidth || pair.bounds.lower >= lowest_refined) break;
    const DistanceBounds exact =
        exact_distance_bounds(tree_a().corners(pair.a), tree_b().corners(pair.b));
    offer(pair.a, pair.b, exact.upper);
    lowest_refined = std::min(lowest_refined, exact.lower);
    std::pop_heap(near_.begin(), near_.end(), lower_last);
    near_.pop_back();
  }
  const double lowest_open =
      near_.empty() ? std::numeric_limits<double>::infinity() : near_.front().bounds.lower;
  return {std::min(lowest_refined, lowest_open), upper_};
}

// @pre both are scaled by two to the -exponent
DistanceInterval scaled_distance(const ScaledSurface& a, const ScaledSurface& b, int exponent) {
  DistanceSearch search(a, b);
  const DistanceBounds bounds = unscaled(search.run(), exponent);
  return {bounds.lower, bounds.upper, search.nearest()};
}

}  // namespace

DistanceInterval surface_distance(ScaledSurface& a, ScaledSurface& b) {
  const int exponent =
      exponent_above(std::max(largest_coordinate(a.vertices), largest_coordinate(b.vertices)));
  scale(a, -exponent);
  scale(b, -exponent);
  return scaled_distance(a, b, exponent);
}

std::vector<DistanceInterval> point_distances(std::span<const Vec3> points,
                                              ScaledSurface& surface) {
  const FloatingPointGuard guard;
  const double largest = largest_coordinate(surface.vertices);
  std::vector<int> exponents;
  for (const Vec3& p : points)
    exponents.push_back(exponent_above(std::max(largest, p.cwiseAbs().maxCoeff())));
  // Each point with the surface in its own scale: one that is far away widens no other interval.
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return exponents[i] < exponents[j]; });
  SurfaceTree point_tree(TriangleMesh{{Vec3::Zero()}, {{0, 0, 0}}});
  ScaledSurface point;
  point.tree = &point_tree;
  std::vector<DistanceInterval> out(points.size());
  std::optional<int> fitted;
  for (const std::size_t i : order) {
    if (fitted != exponents[i]) scale(surface, -exponents[i]);
    fitted = exponents[i];
    point.vertices = points.subspan(i, 1);
    scale(point, -exponents[i]);
    out[i] = scaled_distance(point, surface, exponents[i]);
  }
  return out;
}

}  // namespace contactcheck::oracle
