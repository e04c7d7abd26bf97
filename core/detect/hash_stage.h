// The spatial-hash stage in its two readings.
#pragma once

#include <cstdint>
#include <vector>

#include "core/broad/box_pairs.h"
#include "core/broad/spatial_hash.h"
#include "core/detect/ffd_state.h"
#include "core/detect/sphere_stage.h"

namespace contactcheck {

/// A probe is a node that the paper hashes: a corner of a cell's FFD-AABB (index 8 * cell +
/// corner), or a lattice node, which stands for every kept cell around it (ffd-grid).
struct ProbeHit {
  std::uint32_t body_a = 0, probe = 0;
  std::uint32_t body_b = 0, cell_b = 0;
};

/// Position of a probe in its body's current state.
template <typename T>
Vec3Of<T> probe_position(const FfdStateOf<T>& state, CellVolume volume, std::uint32_t probe);

/// Calls `visit(cell)` for every cell a probe stands for.
template <typename Visit>
void for_cells_of_probe(const FfdStructure& model, CellVolume volume, std::uint32_t probe,
                        Visit&& visit) {
  if (volume == CellVolume::kFfdAabb) {
    visit(probe / 8);
  } else {
    for (std::uint32_t cell : model.node_cells.row(probe)) visit(cell);
  }
}

/// Reading `paper`: a node goes into the one bucket that contains it, a box into the buckets of its
/// eight nodes. Only nodes of colliding bodies take part; from two sphere levels on, only those
/// strictly inside a colliding sphere of the finest level.
template <typename T>
class ProbeHashStageOf {
 public:
  /// `grid_offset` is added to every probe before it is hashed: which nodes share a bucket depends
  /// on where the grid lies.
  void run(const FfdModels<T>& models, const FfdStates<T>& states, const FfdConfig& config,
           const SphereSurvivors& survivors, T cell_size, const Vec3Of<T>& grid_offset,
           std::vector<ProbeHit>& out);
  /// Per body: the probes that take part. For the stage trace.
  static std::vector<std::vector<char>> active_probes(const FfdModels<T>& models,
                                                      const FfdStates<T>& states,
                                                      const FfdConfig& config,
                                                      const SphereSurvivors& survivors);

 private:
  struct BoxId {
    std::uint32_t body, cell;
  };
  static void find_active_probes(const FfdModels<T>& models, const FfdStates<T>& states,
                                 const FfdConfig& config, const SphereSurvivors& survivors,
                                 std::vector<std::vector<char>>& active);
  void find_keys(const FfdStates<T>& states, CellVolume volume, T cell_size,
                 const Vec3Of<T>& grid_offset);
  void hash_boxes(const FfdModels<T>& models, const FfdConfig& config);

  std::vector<std::vector<char>> active_;   // per body and probe
  std::vector<std::vector<GridKey>> keys_;  // per body and probe; set for active probes
  SpatialHash hash_;
  std::vector<BoxId> boxes_;
};

/// Reading `safe`: the AABB of an owner cell goes into every bucket it meets. Survivors are pairs
/// of owner cells whose AABBs overlap, among them all pairs under colliding finest spheres. (An
/// owner outside the common parts of its sphere's bounds with those of the spheres that this one
/// collides with is not in such a pair and is not hashed.)
template <typename T>
class BoxHashStageOf {
 public:
  void run(const FfdModels<T>& models, const FfdStates<T>& states, const FfdConfig& config,
           const SphereSurvivors& survivors, T cell_size, std::vector<ElementPair>& out);
  static std::vector<std::vector<char>> active_cells(const FfdModels<T>& models,
                                                     const FfdConfig& config,
                                                     const SphereSurvivors& survivors);

 private:
  // Where the cells under one finest sphere can meet others.
  struct Group {
    AabbOf<T> bounds;
    AabbOf<T> reach;  // bounds of the regions
    std::vector<AabbOf<T>> regions;
    bool meets(const AabbOf<T>& box) const;
  };
  void find_regions(const FfdModels<T>& models, const FfdStates<T>& states, const FfdConfig& config,
                    const SphereSurvivors& survivors);
  void collect_boxes(const FfdModels<T>& models, const FfdStates<T>& states,
                     const FfdConfig& config);

  std::vector<std::vector<Group>> groups_;  // per body and finest sphere
  BoxPairFinderOf<T> finder_;
  std::vector<OwnedBoxOf<T>> boxes_;
  std::vector<typename BoxPairFinderOf<T>::Pair> pairs_;
};

}  // namespace contactcheck
