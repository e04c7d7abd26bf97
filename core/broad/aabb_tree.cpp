#include "core/broad/aabb_tree.h"

#include "core/types/check.h"

namespace contactcheck {

template <typename T>
AabbTreeOf<T>::AabbTreeOf(std::shared_ptr<const TriangleTree> tree)
    : tree_(std::move(tree)), nodes_(tree_->nodes.size()), triangles_(tree_->ids.size()) {}

template <typename T>
void AabbTreeOf<T>::refit(std::span<const Vec3Of<T>> vertices) {
  for (std::size_t slot = 0; slot < triangles_.size(); ++slot) {
    const auto& [a, b, c] = tree_->corners[slot];
    const Vec3Of<T>& p = vertices[a];
    const Vec3Of<T>& q = vertices[b];
    const Vec3Of<T>& r = vertices[c];
    triangles_[slot] = {p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)};
  }
  refit_nodes();
}

template <typename T>
void AabbTreeOf<T>::refit(std::span<const Vec3Of<T>> start, std::span<const Vec3Of<T>> end) {
  for (std::size_t slot = 0; slot < triangles_.size(); ++slot) {
    const auto& [a, b, c] = tree_->corners[slot];
    const auto low = [&](const auto& v) { return v[a].cwiseMin(v[b]).cwiseMin(v[c]).eval(); };
    const auto high = [&](const auto& v) { return v[a].cwiseMax(v[b]).cwiseMax(v[c]).eval(); };
    triangles_[slot] = {low(start).cwiseMin(low(end)), high(start).cwiseMax(high(end))};
  }
  refit_nodes();
}

template <typename T>
void AabbTreeOf<T>::refit_nodes() {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    const TriangleTree::Node node = tree_->nodes[n];
    const std::vector<AabbOf<T>>& parts = node.leaf() ? triangles_ : nodes_;
    AabbOf<T> box = parts[node.first];
    const std::uint32_t count = node.leaf() ? node.count : 2;
    for (std::uint32_t i = 1; i < count; ++i) box.extend(parts[node.first + i]);
    nodes_[n] = box;
  }
}

template <typename T>
std::string AabbTreeOf<T>::validate(std::span<const Vec3Of<T>> vertices) const {
  for (std::size_t slot = 0; slot < triangles_.size(); ++slot)
    for (std::uint32_t v : tree_->corners[slot])
      if (!triangles_[slot].contains(vertices[v]))
        return "the box of slot " + std::to_string(slot) + " does not hold its triangle";
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const TriangleTree::Node node = tree_->nodes[n];
    const std::vector<AabbOf<T>>& parts = node.leaf() ? triangles_ : nodes_;
    for (std::uint32_t i = 0; i < (node.leaf() ? node.count : 2); ++i)
      if (!nodes_[n].contains(parts[node.first + i]))
        return "the box of node " + std::to_string(n) + " does not hold its parts";
  }
  return "";
}

template <typename T>
void AabbTreesOf<T>::prepare(const std::vector<Body>& bodies) {
  trees_.clear();
  for (auto& tree : make_triangle_trees(bodies, leaf_size_)) trees_.emplace_back(std::move(tree));
}

template <typename T>
void AabbTreesOf<T>::update(const std::vector<std::span<const Vec3Of<T>>>& vertices) {
  CONTACTCHECK_INVARIANT(vertices.size() == trees_.size(), "one state per prepared body");
  for (std::size_t body = 0; body < trees_.size(); ++body) trees_[body].refit(vertices[body]);
}

template <typename T>
void AabbTreesOf<T>::update(const std::vector<std::span<const Vec3Of<T>>>& start,
                            const std::vector<std::span<const Vec3Of<T>>>& end) {
  CONTACTCHECK_INVARIANT(start.size() == trees_.size() && end.size() == trees_.size(),
                         "one state per prepared body at both ends");
  for (std::size_t body = 0; body < trees_.size(); ++body)
    trees_[body].refit(start[body], end[body]);
}

template class AabbTreeOf<double>;
template class AabbTreeOf<float>;
template class AabbTreesOf<double>;
template class AabbTreesOf<float>;

}  // namespace contactcheck
