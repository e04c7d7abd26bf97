// The detector `bd-tree`: BD-trees as broad phase, an exact test of triangles behind them.
// Source: James & Pai: BD-Tree: Output-Sensitive Collision Detection for Reduced Deformable Models,
// ACM TOG 23(3), 2004.
//
// Guarantee: it reports exactly the intersecting pairs of triangles, for all finite frames (see
// core/broad/bd_tree.h). Vertices are mapped where traversals reach leaves, with the canonical
// bits. In single precision nodes are rounded about the local origin of the frame, vertices mapped
// from those floats; the pairs are exactly those that intersect among them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/broad/bd_tree.h"
#include "core/detect/detector.h"

namespace contactcheck {

template <typename T>
class BdTreeDetectorOf : public Detector {
 public:
  explicit BdTreeDetectorOf(const BdSettings& settings);

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return false; }
  /// @throws RefusedInput when a body has no lattice
  void prepare(const std::vector<Body>& bodies) override;
  /// @throws RefusedInput when a node is beyond single precision (round_to_local)
  void update(const Frame& frame) override;
  void query(Question question, ContactSet& out) override;
  StageTrace trace() override;

  /// For tests: the trees as the last query left them.
  const std::vector<BdTreeOf<T>>& trees() const { return trees_; }

 private:
  struct Leaves {
    std::uint32_t body_a, body_b, leaf_a, leaf_b;
  };
  /// Calls `visit(Leaves)` for every two leaves whose spheres overlap; true: the rest of these two
  /// bodies is skipped.
  template <typename Visit>
  void visit_leaves(Visit&& visit);
  template <typename Found>
  bool test_leaves(const Leaves& leaves, Found&& found);
  void find_triangles(std::vector<ElementPair>& out);

  BdSettings settings_;
  Semantics semantics_;
  std::vector<BdTreeOf<T>> trees_;
  // Single precision only, per body: nodes as floats, and the same values as doubles.
  std::vector<std::vector<Vec3f>> floats_;
  std::vector<std::vector<Vec3>> rounded_;
  std::vector<std::uint64_t> triangles_;  // per body
  std::vector<NodePair> stack_;
  std::uint64_t visited_ = 0;  // pairs of spheres compared by the last traversal
};
using BdTreeDetector = BdTreeDetectorOf<double>;

}  // namespace contactcheck
