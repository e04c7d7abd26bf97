// Branch and bound over the box tree, nearer boxes first. What could be as near as the nearest,
// within the tolerance, is kept with its certified bounds; where these are too wide, rational
// arithmetic narrows them.
#include "reference/oracle/nearest_surface.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "reference/oracle/convex_parting.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/vertex_distance.h"

namespace contactcheck::oracle {
namespace {

// In fractions of the size: what counts as equally near, and how wide bounds may be.
constexpr double kAsNear = 1e-9, kBoundsWidth = 5e-13;
// A rounded distance to a box exceeds the true one by less than 8 * 2^-53 of it.
constexpr double kBoxDistanceRounding = 1 - 16 * 0x1p-53;

struct Candidate {
  std::uint32_t triangle;
  NearestPoint point;
};

double distance_to(const Aabb& box, const Vec3& p) {
  return (box.lo - p).cwiseMax(p - box.hi).cwiseMax(0.0).norm() * kBoxDistanceRounding;
}

class NearestSearch {
 public:
  NearestSearch(const Vec3& vertex, const SurfaceTree& surface, double size)
      : vertex_(vertex), surface_(surface), size_(size) {}

  WayOut run();

 private:
  bool worth(double distance) const { return distance <= upper_ + kAsNear * size_; }
  void descend(std::uint32_t index);
  void measure(std::uint32_t triangle);
  void drop_farther();
  void narrow();
  WayOut collect();

  const Vec3& vertex_;
  const SurfaceTree& surface_;
  double size_;
  double upper_ = std::numeric_limits<double>::infinity();
  std::vector<Candidate> near_;
};

void NearestSearch::descend(std::uint32_t index) {
  const SurfaceTree::Node& node = surface_.node(index);
  if (!worth(distance_to(node.box, vertex_))) return;
  if (node.is_leaf()) {
    for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
      if (worth(distance_to(surface_.box_at(place), vertex_))) measure(surface_.triangle_at(place));
    return;
  }
  std::uint32_t first = index + 1, second = node.second;
  if (distance_to(surface_.node(second).box, vertex_) <
      distance_to(surface_.node(first).box, vertex_))
    std::swap(first, second);
  descend(first);
  descend(second);
}

void NearestSearch::measure(std::uint32_t triangle) {
  const NearestPoint point = nearest_point(vertex_, surface_.corners(triangle));
  if (!worth(point.lower)) return;
  upper_ = std::min(upper_, point.upper);
  near_.push_back({triangle, point});
}

void NearestSearch::drop_farther() {
  std::erase_if(near_, [&](const Candidate& c) { return !worth(c.point.lower); });
}

void NearestSearch::narrow() {
  for (Candidate& c : near_) {
    if (c.point.upper - c.point.lower <= kBoundsWidth * size_) continue;
    c.point = exact_nearest_point(vertex_, surface_.corners(c.triangle));
    upper_ = std::min(upper_, c.point.upper);
  }
}

WayOut NearestSearch::collect() {
  const auto touches = [&](const Candidate& c) {
    return c.point.lower == 0 && point_on_triangle(vertex_, surface_.corners(c.triangle));
  };
  WayOut out;
  if (std::any_of(near_.begin(), near_.end(), touches)) return out;
  std::stable_sort(near_.begin(), near_.end(), [](const Candidate& x, const Candidate& y) {
    return x.point.offset.squaredNorm() < y.point.offset.squaredNorm();
  });
  out.depth = near_.front().point.offset.norm();
  for (const Candidate& c : near_) {
    const double length = c.point.offset.norm();
    if (length > 0) add_direction(c.point.offset / length, out.directions);
  }
  return out;
}

WayOut NearestSearch::run() {
  descend(0);
  drop_farther();
  narrow();
  drop_farther();
  return collect();
}

}  // namespace

WayOut way_to_surface(const Vec3& vertex, const SurfaceTree& surface, double size) {
  return NearestSearch(vertex, surface, size).run();
}

}  // namespace contactcheck::oracle
