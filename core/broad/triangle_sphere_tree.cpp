#include "core/broad/triangle_sphere_tree.h"

#include <algorithm>
#include <cmath>

#include "core/types/check.h"

namespace contactcheck {

template <typename T>
SphereOf<T> enclosing_sphere(const SphereOf<T>& a, const SphereOf<T>& b) {
  const Vec3Of<T> step = b.center - a.center;
  const T squared = step.squaredNorm(), distance = std::sqrt(squared);
  SphereOf<T> out;
  out.center = a.center;
  if (distance > 0 && std::isfinite(distance)) {
    // The parameter on the segment from a to b; NaN (both radii infinite) stays at a.
    const T share = T(0.5) + T(0.5) * (b.radius - a.radius) / distance;
    if (share > 0) out.center += std::min(share, T(1)) * step;
  }
  // The radius of a child is the slack of covering_radius(), which rounds distance plus slack up:
  // the ball round `out.center` holds the child's.
  const T to_a = covering_radius((a.center - out.center).squaredNorm(), a.radius);
  const T to_b = covering_radius((b.center - out.center).squaredNorm(), b.radius);
  out.radius = std::max(to_a, to_b);
  return out;
}

template <typename T>
SphereOf<T> enclosing_sphere(const AabbOf<T>& box) {
  SphereOf<T> out;
  out.center = box.center();
  const Vec3Of<T> farthest = (box.hi - out.center).cwiseMax(out.center - box.lo);
  out.radius = covering_radius(farthest.squaredNorm(), T(0));
  return out;
}

template <typename T>
TriangleSphereTreeOf<T>::TriangleSphereTreeOf(std::shared_ptr<const TriangleTree> tree)
    : tree_(std::move(tree)), nodes_(tree_->nodes.size()), boxes_(nodes_.size()) {}

template <typename T>
void TriangleSphereTreeOf<T>::fit_leaf(std::size_t node, std::span<const Vec3Of<T>> vertices) {
  const TriangleTree::Node& leaf = tree_->nodes[node];
  const std::span corners = std::span(tree_->corners).subspan(leaf.first, leaf.count);
  AabbOf<T> box;
  for (const Triangle& t : corners)
    for (std::uint32_t v : t) box.extend(vertices[v]);
  const Vec3Of<T> center = box.center();
  T largest = 0;
  for (const Triangle& t : corners)
    for (std::uint32_t v : t) largest = std::max(largest, (vertices[v] - center).squaredNorm());
  boxes_[node] = box;
  nodes_[node] = {center, covering_radius(largest, T(0))};
}

template <typename T>
void TriangleSphereTreeOf<T>::fit_parent(std::size_t node) {
  const std::uint32_t first = tree_->nodes[node].first, second = first + 1;
  boxes_[node] = boxes_[first];
  boxes_[node].extend(boxes_[second]);
  const SphereOf<T> children = enclosing_sphere(nodes_[first], nodes_[second]);
  const SphereOf<T> box = enclosing_sphere(boxes_[node]);
  nodes_[node] = box.radius < children.radius ? box : children;
}

template <typename T>
void TriangleSphereTreeOf<T>::refit(std::span<const Vec3Of<T>> vertices) {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    if (tree_->nodes[n].leaf()) {
      fit_leaf(n, vertices);
    } else {
      fit_parent(n);
    }
  }
}

template <typename T>
void TriangleSphereTreesOf<T>::prepare(const std::vector<Body>& bodies) {
  trees_.clear();
  for (auto& tree : make_triangle_trees(bodies, leaf_size_)) trees_.emplace_back(std::move(tree));
}

template <typename T>
void TriangleSphereTreesOf<T>::update(const std::vector<std::span<const Vec3Of<T>>>& vertices) {
  CONTACTCHECK_INVARIANT(vertices.size() == trees_.size(), "one state per prepared body");
  for (std::size_t body = 0; body < trees_.size(); ++body) trees_[body].refit(vertices[body]);
}

template Sphere enclosing_sphere(const Sphere&, const Sphere&);
template SphereOf<float> enclosing_sphere(const SphereOf<float>&, const SphereOf<float>&);
template Sphere enclosing_sphere(const Aabb&);
template SphereOf<float> enclosing_sphere(const AabbOf<float>&);
template class TriangleSphereTreeOf<double>;
template class TriangleSphereTreeOf<float>;
template class TriangleSphereTreesOf<double>;
template class TriangleSphereTreesOf<float>;

}  // namespace contactcheck
