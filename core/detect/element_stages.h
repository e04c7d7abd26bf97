// The two element stages: the paper's test of nodes against planes, and the exact test of
// triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/detect/ffd_state.h"
#include "core/detect/hash_stage.h"
#include "core/narrow/node_plane.h"
#include "core/types/contact_set.h"

namespace contactcheck {

/// The paper's element stage: each node against each plane of the boxes in its bucket.
template <typename T>
class NodePlaneStageOf {
 public:
  /// Forgets the planes of the last frame.
  void begin_frame(const FfdModels<T>& models);

  /// Reading `paper`: reports (cell of the probe, box's cell) for every probe inside its box.
  /// `first_only`: at most one probe per pair of bodies reports.
  void run_probes(const FfdModels<T>& models, const FfdStates<T>& states, CellVolume volume,
                  const std::vector<ProbeHit>& hits, bool first_only,
                  std::vector<ElementPair>& out);
  /// The hits that run_probes() reports, each with its depth and the normal that separates the two
  /// boxes: one contact per probe inside a box, from the nearest plane of that box. A box of which
  /// no face has an area gives none. The normal is that of the pair as appended (moving the box by
  /// depth * normal, or the probe by the opposite, puts the probe on that plane).
  /// @pre probes are corners of FFD-AABBs
  void run_contacts(const FfdModels<T>& models, const FfdStates<T>& states,
                    const std::vector<ProbeHit>& hits, std::vector<PieceContact>& out);
  /// Reading `safe`: every corner of the boxes of one owner cell against the boxes of the other,
  /// both ways.
  void run_cells(const FfdModels<T>& models, const FfdStates<T>& states,
                 const std::vector<ElementPair>& candidates, bool first_only,
                 std::vector<ElementPair>& out);

 private:
  const BoxPlanesOf<T>& planes(const FfdStates<T>& states, std::uint32_t body, std::uint32_t piece);
  bool any_corner_inside(const FfdModels<T>& models, const FfdStates<T>& states,
                         std::uint32_t body_a, std::uint32_t cell_a, std::uint32_t body_b,
                         std::uint32_t cell_b);

  std::vector<std::vector<BoxPlanesOf<T>>> planes_;  // per body and piece
  std::vector<std::vector<char>> known_;
};

/// The element stage of the `+tri` variants: the triangles of candidate cells, exactly (in single
/// precision those of floats).
template <typename T>
class TriangleStageOf {
 public:
  /// `vertices`: per body; they must live until the next frame begins.
  void begin_frame(const FfdModels<T>& models,
                   const std::vector<std::span<const Vec3Of<T>>>& vertices);

  /// Appends every intersecting pair of triangles of each candidate pair of cells, of one body
  /// those that meet beyond what they share (meet_beyond_shared); a pair that is in several cells
  /// may be appended several times.
  void run(const FfdModels<T>& models, const std::vector<ElementPair>& candidates, bool first_only,
           std::vector<ElementPair>& out);
  /// The same for each cell of the body with itself.
  void run_within_cells(const FfdModels<T>& models, std::uint32_t body,
                        std::vector<ElementPair>& out);

 private:
  // Boxes of a cell's triangles, made when a candidate first names the cell.
  struct CellBoxes {
    AabbOf<T> whole;
    std::vector<AabbOf<T>> triangles;
    bool known = false;
  };
  const CellBoxes& boxes(const FfdModels<T>& models, std::uint32_t body, std::uint32_t cell);
  void collect(const FfdModels<T>& models, std::uint32_t body, std::uint32_t cell,
               const AabbOf<T>& region, std::vector<std::uint32_t>& out);
  bool test_pair(const FfdModels<T>& models, const ElementPair& cells, bool first_only,
                 std::vector<ElementPair>& out);

  std::vector<std::span<const Vec3Of<T>>> vertices_;
  std::vector<std::vector<CellBoxes>> boxes_;
  std::vector<std::uint32_t> near_a_, near_b_;  // row positions within the cells
};

}  // namespace contactcheck
