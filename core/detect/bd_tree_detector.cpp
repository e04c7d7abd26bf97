#include "core/detect/bd_tree_detector.h"

#include <type_traits>
#include <utility>

#include "core/detect/fed_vertices.h"
#include "core/detect/triangle_pair_detector.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

template <typename T>
TrianglePointsOf<T> points_of(const BdTreeOf<T>& tree, std::uint32_t slot) {
  const Triangle& t = tree.tree().corners[slot];
  return {tree.vertex(t[0]), tree.vertex(t[1]), tree.vertex(t[2])};
}

template <typename T>
AabbOf<T> box_of(const TrianglePointsOf<T>& p) {
  return {p[0].cwiseMin(p[1]).cwiseMin(p[2]), p[0].cwiseMax(p[1]).cwiseMax(p[2])};
}

}  // namespace

template <typename T>
BdTreeDetectorOf<T>::BdTreeDetectorOf(const BdSettings& settings)
    : settings_(settings), semantics_(exact_triangle_semantics(kPrecision<T>)) {}

template <typename T>
void BdTreeDetectorOf<T>::prepare(const std::vector<Body>& bodies) {
  trees_.clear();
  triangles_.clear();
  for (const auto& model : make_bd_models(bodies, settings_.leaf_size)) {
    triangles_.push_back(model->tree.ids.size());
    trees_.emplace_back(model, settings_);
  }
}

template <typename T>
void BdTreeDetectorOf<T>::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == trees_.size(), "one state per prepared body");
  if constexpr (std::is_same_v<T, float>) {
    // Rounded, and then doubles again: spheres are computed from them in doubles.
    const Vec3 origin = local_origin(frame);
    round_bodies(frame, &BodyState::nodes, origin, floats_);
    rounded_.resize(trees_.size());
    for (std::size_t body = 0; body < trees_.size(); ++body) {
      rounded_[body].clear();
      for (const Vec3f& node : floats_[body]) rounded_[body].push_back(node.cast<double>());
      trees_[body].begin_frame(rounded_[body], origin);
    }
  } else {
    for (std::size_t body = 0; body < trees_.size(); ++body)
      trees_[body].begin_frame(frame.bodies[body].nodes, Vec3::Zero());
  }
}

template <typename T>
template <typename Visit>
void BdTreeDetectorOf<T>::visit_leaves(Visit&& visit) {
  traverse_bodies(trees_, stack_, visited_,
                  [&](BodyPair bodies, std::uint32_t leaf_a, std::uint32_t leaf_b) {
                    return visit(Leaves{bodies.a, bodies.b, leaf_a, leaf_b});
                  });
}

// Calls `found(ElementPair)` for every intersecting pair of triangles until it returns true.
template <typename T>
template <typename Found>
bool BdTreeDetectorOf<T>::test_leaves(const Leaves& leaves, Found&& found) {
  const BdTreeOf<T>&a = trees_[leaves.body_a], &b = trees_[leaves.body_b];
  const TriangleTree::Node node_a = a.tree().nodes[leaves.leaf_a];
  const TriangleTree::Node node_b = b.tree().nodes[leaves.leaf_b];
  for (std::uint32_t i = node_a.first; i < node_a.first + node_a.count; ++i) {
    const TrianglePointsOf<T> p = points_of(a, i);
    const AabbOf<T> box = box_of(p);
    for (std::uint32_t j = node_b.first; j < node_b.first + node_b.count; ++j) {
      const TrianglePointsOf<T> q = points_of(b, j);
      if (!box.overlaps(box_of(q)) || !triangles_intersect(p, q)) continue;
      if (found(ElementPair{leaves.body_a, leaves.body_b, a.tree().ids[i], b.tree().ids[j]}))
        return true;
    }
  }
  return false;
}

template <typename T>
void BdTreeDetectorOf<T>::find_triangles(std::vector<ElementPair>& out) {
  visit_leaves([&](const Leaves& leaves) {
    return test_leaves(leaves, [&](const ElementPair& pair) {
      out.push_back(pair);
      return false;
    });
  });
}

template <typename T>
void BdTreeDetectorOf<T>::query(Question question, ContactSet& out) {
  CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
  if (question == Question::kTriangles) return find_triangles(out.triangles);
  visit_leaves([&](const Leaves& leaves) {
    return test_leaves(leaves, [&](const ElementPair& pair) {
      out.bodies.push_back({pair.body_a, pair.body_b});
      return true;
    });
  });
}

template <typename T>
StageTrace BdTreeDetectorOf<T>::trace() {
  StageTrace out;
  std::vector<ElementPair> candidates, exact;
  visit_leaves([&](const Leaves& leaves) {
    return visit_leaf_pairs({leaves.body_a, leaves.body_b}, trees_[leaves.body_a].tree(),
                            leaves.leaf_a, trees_[leaves.body_b].tree(), leaves.leaf_b,
                            [&](const ElementPair& pair) {
                              candidates.push_back(pair);
                              return false;
                            });
  });
  out.stages.push_back(
      triangle_record("spheres", brute_force_pairs(triangles_), std::move(candidates)));
  out.stages[0].visited = visited_;
  out.stages[0].visited_unit = "sphere pairs";
  find_triangles(exact);
  out.stages.push_back(triangle_record("triangles", out.stages[0].out, std::move(exact)));
  return out;
}

template class BdTreeDetectorOf<double>;
template class BdTreeDetectorOf<float>;

}  // namespace contactcheck
