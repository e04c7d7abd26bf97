#include "core/broad/triangle_sphere_tree.h"

#include <algorithm>
#include <cmath>

#include "core/types/check.h"

namespace contactcheck {

Sphere enclosing_sphere(const Sphere& a, const Sphere& b) {
  const Vec3 step = b.center - a.center;
  const double squared = step.squaredNorm(), distance = std::sqrt(squared);
  Sphere out;
  out.center = a.center;
  if (distance > 0.0 && std::isfinite(distance)) {
    // Share of the way from a to b; NaN (both radii infinite) stays at a.
    const double share = 0.5 + 0.5 * (b.radius - a.radius) / distance;
    if (share > 0.0) out.center += std::min(share, 1.0) * step;
  }
  // The radius of a child stands as slack in covering_radius(), which rounds distance plus slack
  // up: the ball round `out.center` holds the child's.
  const double to_a = covering_radius((a.center - out.center).squaredNorm(), a.radius);
  const double to_b = covering_radius((b.center - out.center).squaredNorm(), b.radius);
  out.radius = std::max(to_a, to_b);
  return out;
}

Sphere enclosing_sphere(const Aabb& box) {
  Sphere out;
  out.center = box.center();
  const Vec3 farthest = (box.hi - out.center).cwiseMax(out.center - box.lo);
  out.radius = covering_radius(farthest.squaredNorm(), 0.0);
  return out;
}

TriangleSphereTree::TriangleSphereTree(std::shared_ptr<const TriangleTree> tree)
    : tree_(std::move(tree)), nodes_(tree_->nodes.size()), boxes_(nodes_.size()) {}

void TriangleSphereTree::fit_leaf(std::size_t node, std::span<const Vec3> vertices) {
  const TriangleTree::Node& leaf = tree_->nodes[node];
  const std::span corners = std::span(tree_->corners).subspan(leaf.first, leaf.count);
  Aabb box;
  for (const Triangle& t : corners)
    for (std::uint32_t v : t) box.extend(vertices[v]);
  const Vec3 center = box.center();
  double largest = 0.0;
  for (const Triangle& t : corners)
    for (std::uint32_t v : t) largest = std::max(largest, (vertices[v] - center).squaredNorm());
  boxes_[node] = box;
  nodes_[node] = {center, covering_radius(largest, 0.0)};
}

void TriangleSphereTree::fit_parent(std::size_t node) {
  const std::uint32_t first = tree_->nodes[node].first, second = first + 1;
  boxes_[node] = boxes_[first];
  boxes_[node].extend(boxes_[second]);
  const Sphere children = enclosing_sphere(nodes_[first], nodes_[second]);
  const Sphere box = enclosing_sphere(boxes_[node]);
  nodes_[node] = box.radius < children.radius ? box : children;
}

void TriangleSphereTree::refit(std::span<const Vec3> vertices) {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    if (tree_->nodes[n].leaf()) {
      fit_leaf(n, vertices);
    } else {
      fit_parent(n);
    }
  }
}

void TriangleSphereTrees::prepare(const std::vector<Body>& bodies) {
  trees_.clear();
  for (auto& tree : make_triangle_trees(bodies, leaf_size_)) trees_.emplace_back(std::move(tree));
}

void TriangleSphereTrees::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == trees_.size(), "one state per prepared body");
  for (std::size_t body = 0; body < trees_.size(); ++body)
    trees_[body].refit(frame.bodies[body].vertices);
}

}  // namespace contactcheck
