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
Vec3 probe_position(const FfdState& state, CellVolume volume, std::uint32_t probe);

/// Calls `visit(cell)` for every cell a probe stands for.
template <typename Visit>
void for_cells_of_probe(const FfdModel& model, CellVolume volume, std::uint32_t probe,
                        Visit&& visit) {
  if (volume == CellVolume::kFfdAabb) {
    visit(probe / 8);
  } else {
    for (std::uint32_t cell : model.node_cells.row(probe)) visit(cell);
  }
}

/// Reading `paper`: a node goes into the one bucket that holds it, a box into the buckets of its
/// eight nodes; only nodes inside colliding spheres of the finest level (strictly inside, from two
/// levels on) take part.
class ProbeHashStage {
 public:
  void run(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
           const FfdConfig& config, const SphereSurvivors& survivors, double cell_size,
           std::vector<ProbeHit>& out);
  /// Per body: the probes that take part. For the stage trace.
  static std::vector<std::vector<char>> active_probes(const std::vector<FfdModel>& models,
                                                      const std::vector<FfdState>& states,
                                                      const FfdConfig& config,
                                                      const SphereSurvivors& survivors);

 private:
  struct BoxId {
    std::uint32_t body, cell;
  };
  static void find_active_probes(const std::vector<FfdModel>& models,
                                 const std::vector<FfdState>& states, const FfdConfig& config,
                                 const SphereSurvivors& survivors,
                                 std::vector<std::vector<char>>& active);
  void find_keys(const std::vector<FfdState>& states, CellVolume volume, double cell_size);
  void hash_boxes(const std::vector<FfdModel>& models, const FfdConfig& config);

  std::vector<std::vector<char>> active_;   // per body and probe
  std::vector<std::vector<GridKey>> keys_;  // the same; of active probes
  SpatialHash hash_;
  std::vector<BoxId> boxes_;
};

/// Reading `safe`: the AABB of an owner cell goes into every bucket it meets; survivors are all
/// pairs of owner cells, of colliding finest spheres, whose AABBs overlap. (An owner outside the
/// common parts of its sphere's bounds with those of the spheres that this one collides with has no
/// such pair and is not hashed.)
class BoxHashStage {
 public:
  void run(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
           const FfdConfig& config, const SphereSurvivors& survivors, double cell_size,
           std::vector<ElementPair>& out);
  static std::vector<std::vector<char>> active_cells(const std::vector<FfdModel>& models,
                                                     const FfdConfig& config,
                                                     const SphereSurvivors& survivors);

 private:
  // The cells under one finest sphere, and where they can meet others.
  struct Group {
    Aabb bounds;
    Aabb reach;  // bounds of the regions
    std::vector<Aabb> regions;
    bool meets(const Aabb& box) const;
  };
  void find_regions(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
                    const FfdConfig& config, const SphereSurvivors& survivors);
  void collect_boxes(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
                     const FfdConfig& config);

  std::vector<std::vector<Group>> groups_;  // per body and finest sphere
  BoxPairFinder finder_;
  std::vector<OwnedBox> boxes_;
  std::vector<BoxPairFinder::Pair> pairs_;
};

}  // namespace contactcheck
