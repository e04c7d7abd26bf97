#include "core/broad/aabb_tree.h"

#include "core/types/check.h"

namespace contactcheck {

AabbTree::AabbTree(std::shared_ptr<const TriangleTree> tree)
    : tree_(std::move(tree)), nodes_(tree_->nodes.size()), triangles_(tree_->ids.size()) {}

void AabbTree::refit(std::span<const Vec3> vertices) {
  for (std::size_t slot = 0; slot < triangles_.size(); ++slot) {
    const auto& [a, b, c] = tree_->corners[slot];
    const Vec3 &p = vertices[a], &q = vertices[b], &r = vertices[c];
    triangles_[slot] = {p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)};
  }
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    const TriangleTree::Node node = tree_->nodes[n];
    const std::vector<Aabb>& parts = node.leaf() ? triangles_ : nodes_;
    Aabb box = parts[node.first];
    const std::uint32_t count = node.leaf() ? node.count : 2;
    for (std::uint32_t i = 1; i < count; ++i) box.extend(parts[node.first + i]);
    nodes_[n] = box;
  }
}

std::string AabbTree::validate(std::span<const Vec3> vertices) const {
  for (std::size_t slot = 0; slot < triangles_.size(); ++slot)
    for (std::uint32_t v : tree_->corners[slot])
      if (!triangles_[slot].contains(vertices[v]))
        return "the box of slot " + std::to_string(slot) + " does not hold its triangle";
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const TriangleTree::Node node = tree_->nodes[n];
    const std::vector<Aabb>& parts = node.leaf() ? triangles_ : nodes_;
    for (std::uint32_t i = 0; i < (node.leaf() ? node.count : 2); ++i)
      if (!nodes_[n].contains(parts[node.first + i]))
        return "the box of node " + std::to_string(n) + " does not hold its parts";
  }
  return "";
}

void AabbTrees::prepare(const std::vector<Body>& bodies) {
  trees_.clear();
  for (auto& tree : make_triangle_trees(bodies, leaf_size_)) trees_.emplace_back(std::move(tree));
}

void AabbTrees::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == trees_.size(), "one state per prepared body");
  for (std::size_t body = 0; body < trees_.size(); ++body)
    trees_[body].refit(frame.bodies[body].vertices);
}

}  // namespace contactcheck
