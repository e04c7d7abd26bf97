#include "reference/scene/first_touch.h"

#include <algorithm>
#include <array>
#include <queue>
#include <vector>

#include "core/narrow/triangle_triangle.h"

namespace contactcheck::scene {
namespace {

TrianglePoints corners_of(const OffsetSurface& surface, std::size_t slot) {
  const Triangle& t = surface.tree().corners[slot];
  return {surface.vertices[t[0]] + surface.offset, surface.vertices[t[1]] + surface.offset,
          surface.vertices[t[2]] + surface.offset};
}

Aabb moved(const Aabb& box, const Vec3& offset) { return {box.lo + offset, box.hi + offset}; }

/// Heights along the direction, seen from above.
class View {
 public:
  explicit View(const AxisDirection& from)
      : axis_(from.axis), u_((from.axis + 1) % 3), v_((from.axis + 2) % 3), sign_(from.sign) {}

  bool overlap(const Aabb& a, const Aabb& b) const {
    return a.lo[u_] <= b.hi[u_] && b.lo[u_] <= a.hi[u_] && a.lo[v_] <= b.hi[v_] &&
           b.lo[v_] <= a.hi[v_];
  }
  // No point of two surfaces in these boxes is further apart along the direction. Subtraction is
  // monotone in doubles, so this bounds the bounds of all boxes inside, too.
  double bound(const Aabb& resting, const Aabb& moving) const {
    const double top = sign_ > 0.0 ? resting.hi[axis_] : -resting.lo[axis_];
    const double bottom = sign_ > 0.0 ? moving.lo[axis_] : -moving.hi[axis_];
    return top - bottom;
  }

  // The largest difference of the heights of two triangles over what their outlines share: at a
  // corner of it. Clipping: Sutherland, Hodgman: Reentrant Polygon Clipping, 1974.
  std::optional<double> difference(const TrianglePoints& resting,
                                   const TrianglePoints& moving) const {
    const std::array<Point, 3> base = {seen(resting[0]), seen(resting[1]), seen(resting[2])};
    const double area = side(base[0], base[1], base[2]);
    if (!(area > 0.0) && !(area < 0.0)) return std::nullopt;
    const double turn = area > 0.0 ? 1.0 : -1.0;
    std::vector<Point>& outline = outline_;
    outline = {seen(moving[0]), seen(moving[1]), seen(moving[2])};
    for (std::size_t e = 0; e < 3 && !outline.empty(); ++e) {
      clipped_.clear();
      const Point &a = base[e], &b = base[(e + 1) % 3];
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point &p = outline[i], &q = outline[(i + 1) % outline.size()];
        const double at_p = turn * side(a, b, p), at_q = turn * side(a, b, q);
        if (at_p >= 0.0) clipped_.push_back(p);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0)) {
          const double w = at_p / (at_p - at_q);
          clipped_.push_back({p.u + w * (q.u - p.u), p.v + w * (q.v - p.v), p.h + w * (q.h - p.h)});
        }
      }
      outline.swap(clipped_);
    }
    const auto [low, high] = std::minmax({base[0].h, base[1].h, base[2].h});
    std::optional<double> best;
    for (const Point& p : outline) {
      const double s = side(base[2], base[0], p) / area, t = side(base[0], base[1], p) / area;
      const double height = base[0].h + s * (base[1].h - base[0].h) + t * (base[2].h - base[0].h);
      const double gap = std::clamp(height, low, high) - p.h;
      if (!best || gap > *best) best = gap;
    }
    return best;
  }

 private:
  struct Point {
    double u = 0.0, v = 0.0, h = 0.0;
  };
  Point seen(const Vec3& p) const { return {p[u_], p[v_], sign_ * p[axis_]}; }
  static double side(const Point& a, const Point& b, const Point& p) {
    return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
  }

  int axis_, u_, v_;
  double sign_;
  mutable std::vector<Point> outline_, clipped_;  // kept for their capacity
};

}  // namespace

std::optional<double> first_touch(const OffsetSurface& resting, const OffsetSurface& moving,
                                  const AxisDirection& from, double beyond) {
  const View view(from);
  const TriangleTree &tree_a = resting.tree(), &tree_b = moving.tree();
  struct Open {
    double bound;
    NodePair nodes;
    bool operator<(const Open& other) const { return bound < other.bound; }
  };
  std::priority_queue<Open> open;  // the most promising pair first
  double best = beyond;
  const auto push = [&](std::uint32_t a, std::uint32_t b) {
    const Aabb box_a = resting.box(a), box_b = moving.box(b);
    const double bound = view.bound(box_a, box_b);
    if (bound > best && view.overlap(box_a, box_b)) open.push({bound, {a, b}});
  };
  push(0, 0);
  bool found = false;
  while (!open.empty() && open.top().bound > best) {
    const NodePair pair = open.top().nodes;
    open.pop();
    const TriangleTree::Node &a = tree_a.nodes[pair.a], &b = tree_b.nodes[pair.b];
    if (!a.leaf() && (b.leaf() || resting.size(pair.a) >= moving.size(pair.b))) {
      push(a.first, pair.b);
      push(a.first + 1, pair.b);
      continue;
    }
    if (!b.leaf()) {
      push(pair.a, b.first);
      push(pair.a, b.first + 1);
      continue;
    }
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
      const Aabb box_a = moved(resting.boxes.triangle_box(i), resting.offset);
      const TrianglePoints points = corners_of(resting, i);
      for (std::uint32_t j = b.first; j < b.first + b.count; ++j) {
        const Aabb box_b = moved(moving.boxes.triangle_box(j), moving.offset);
        const double bound = view.bound(box_a, box_b);
        if (!(bound > best) || !view.overlap(box_a, box_b)) continue;
        const auto gap = view.difference(points, corners_of(moving, j));
        if (!gap || !(std::min(*gap, bound) > best)) continue;
        best = std::min(*gap, bound);
        found = true;
      }
    }
  }
  return found ? std::optional(best) : std::nullopt;
}

bool surfaces_touch(const OffsetSurface& a, const OffsetSurface& b) {
  std::vector<NodePair> stack;
  std::uint64_t visited = 0;
  bool touch = false;
  traverse_pairs(a, b, stack, visited, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
    const TriangleTree::Node &in_a = a.tree().nodes[leaf_a], &in_b = b.tree().nodes[leaf_b];
    for (std::uint32_t i = in_a.first; i < in_a.first + in_a.count && !touch; ++i)
      for (std::uint32_t j = in_b.first; j < in_b.first + in_b.count && !touch; ++j)
        touch = triangles_intersect(corners_of(a, i), corners_of(b, j));
    return touch;
  });
  return touch;
}

}  // namespace contactcheck::scene
