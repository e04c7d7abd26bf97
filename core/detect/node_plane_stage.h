// The paper's element stage: each node against each plane of the boxes in its bucket.
#pragma once

#include <vector>

#include "core/detect/ffd_state.h"
#include "core/detect/hash_stage.h"
#include "core/narrow/node_plane.h"
#include "core/types/contact_set.h"

namespace contactcheck {

template <typename T>
class NodePlaneStageOf {
 public:
  /// Forgets the planes of the last frame.
  void begin_frame(const FfdModels<T>& models);

  /// Reading `paper`: reports (cell of the probe, box's cell) for every probe inside its box.
  /// `first_only`: at most one report per pair of bodies.
  void run_probes(const FfdModels<T>& models, const FfdStates<T>& states, CellVolume volume,
                  const std::vector<ProbeHit>& hits, bool first_only,
                  std::vector<ElementPair>& out);
  /// The hits that run_probes() reports, each with its depth and the normal that parts the two
  /// boxes: one contact per probe inside a box, from the nearest plane of that box. A box of which
  /// no face has an area gives none. The normal is that of the pair as appended (moving the box by
  /// depth * normal, or the probe by the opposite, brings the probe onto that plane).
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

}  // namespace contactcheck
