// Spatial hashing of the boxes of triangles of deforming bodies, anew in every frame.
// Source: Teschner, Heidelberger, Mueller, Pomeranets, Gross: Optimized Spatial Hashing for
// Collision Detection of Deformable Objects, VMV 2003, there for vertices against tetrahedra; here
// both sides are triangles, each in every bucket that its box meets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/broad/box_pairs.h"
#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/vec3.h"

namespace contactcheck {

struct TriangleHashSettings {
  double cell = 2.0;  ///< edge of the hash grid, in mean edges of the triangles' boxes at rest
  std::uint32_t table_size = 0;  ///< see SpatialHash
};

/// The broad phase of a TrianglePairDetector. Candidates: pairs of triangles whose boxes overlap,
/// each exactly once, pairs of bodies mixed. Triangles outside the common part of their body's
/// bounds with every other body's have no such pair and are not hashed. Boxes of floats are as
/// exact as those of doubles, and their hash keys as monotone: nothing is rounded outward in
/// either.
template <typename T>
class TriangleHashOf {
 public:
  using Real = T;
  static constexpr const char* kName = "spatial-hash";
  static constexpr const char* kVisitedUnit = "box comparisons";
  static constexpr bool kBoxesOverlap = true;

  explicit TriangleHashOf(const TriangleHashSettings& settings) : settings_(settings) {}

  void prepare(const std::vector<Body>& bodies);
  /// Fits the boxes to the frame and selects the triangles that take part. They are hashed by
  /// visit_candidates(): a frame that is not queried needs no table.
  /// @pre `vertices`: per prepared body, one finite position per vertex
  void update(const std::vector<std::span<const Vec3Of<T>>>& vertices);
  /// Calls `visit(ElementPair)`. The table is walked to its end whatever `visit` returns: all pairs
  /// are found first, as the method has no order of bodies.
  template <typename Visit>
  void visit_candidates(Visit&& visit);
  /// Comparisons of the last traversal: see BoxPairFinderOf::visited().
  std::uint64_t visited() const { return visited_; }

  double cell_size() const { return cell_size_; }  ///< metres
  /// The number of triangles that the last update selected for hashing.
  std::size_t hashed() const { return boxes_.size(); }

 private:
  void fit_bounds(const std::vector<std::span<const Vec3Of<T>>>& vertices);
  void collect_boxes(std::uint32_t body, std::span<const Vec3Of<T>> vertices);
  void find_pairs();

  TriangleHashSettings settings_;
  double cell_size_ = 1.0;
  std::vector<const TriangleMesh*> meshes_;
  std::vector<AabbOf<T>> bounds_;                // per body
  std::vector<std::vector<AabbOf<T>>> regions_;  // per body: its common parts with others
  std::vector<OwnedBoxOf<T>> boxes_;             // `cell` is the triangle
  BoxPairFinderOf<T> finder_;
  std::vector<typename BoxPairFinderOf<T>::Pair> pairs_;
  std::uint64_t visited_ = 0;
};
using TriangleHash = TriangleHashOf<double>;

template <typename T>
template <typename Visit>
void TriangleHashOf<T>::visit_candidates(Visit&& visit) {
  find_pairs();
  for (const auto& [i, j] : pairs_) {
    const OwnedBoxOf<T>&a = boxes_[i], &b = boxes_[j];
    visit(ElementPair{a.body, b.body, a.cell, b.cell});
  }
}

}  // namespace contactcheck
