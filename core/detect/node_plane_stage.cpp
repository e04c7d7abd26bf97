#include "core/detect/node_plane_stage.h"

#include "core/detect/seen_pairs.h"

namespace contactcheck {

template <typename T>
void NodePlaneStageOf<T>::begin_frame(const FfdModels<T>& models) {
  planes_.resize(models.size());
  known_.resize(models.size());
  for (std::size_t body = 0; body < models.size(); ++body) {
    planes_[body].resize(models[body].pieces.size());
    known_[body].assign(models[body].pieces.size(), 0);
  }
}

template <typename T>
const BoxPlanesOf<T>& NodePlaneStageOf<T>::planes(const FfdStates<T>& states, std::uint32_t body,
                                                  std::uint32_t piece) {
  if (!known_[body][piece]) {
    planes_[body][piece] = planes_of_box(states[body].corners[piece]);
    known_[body][piece] = 1;
  }
  return planes_[body][piece];
}

template <typename T>
void NodePlaneStageOf<T>::run_probes(const FfdModels<T>& models, const FfdStates<T>& states,
                                     CellVolume volume, const std::vector<ProbeHit>& hits,
                                     bool first_only, std::vector<ElementPair>& out) {
  SeenPairs seen(models.size());
  for (const ProbeHit& hit : hits) {
    if (first_only && seen.seen(hit.body_a, hit.body_b)) continue;
    // In this reading each kept cell has exactly one box, of the same index.
    const Vec3Of<T> p = probe_position(states[hit.body_a], volume, hit.probe);
    if (!node_inside(planes(states, hit.body_b, hit.cell_b), p)) continue;
    seen.mark(hit.body_a, hit.body_b);
    for_cells_of_probe(models[hit.body_a], volume, hit.probe, [&](std::uint32_t cell) {
      out.push_back({hit.body_a, hit.body_b, cell, hit.cell_b});
    });
  }
}

template <typename T>
void NodePlaneStageOf<T>::run_contacts(const FfdModels<T>& models, const FfdStates<T>& states,
                                       const std::vector<ProbeHit>& hits,
                                       std::vector<PieceContact>& out) {
  constexpr CellVolume kVolume = CellVolume::kFfdAabb;
  for (const ProbeHit& hit : hits) {
    const Vec3Of<T> p = probe_position(states[hit.body_a], kVolume, hit.probe);
    const BoxPlanesOf<T>& box = planes(states, hit.body_b, hit.cell_b);
    if (!node_inside(box, p)) continue;
    const NodeDepth way_out = node_depth(box, p);
    if (way_out.outward.isZero(0.0)) continue;
    for_cells_of_probe(models[hit.body_a], kVolume, hit.probe, [&](std::uint32_t cell) {
      out.push_back({{hit.body_a, hit.body_b, cell, hit.cell_b}, way_out.depth, -way_out.outward});
    });
  }
}

template <typename T>
bool NodePlaneStageOf<T>::any_corner_inside(const FfdModels<T>& models, const FfdStates<T>& states,
                                            std::uint32_t body_a, std::uint32_t cell_a,
                                            std::uint32_t body_b, std::uint32_t cell_b) {
  const FfdModelOf<T>&a = models[body_a], &b = models[body_b];
  for (std::uint32_t q = b.piece_begin[cell_b]; q < b.piece_begin[cell_b + 1]; ++q) {
    const BoxPlanesOf<T>& box = planes(states, body_b, q);
    for (std::uint32_t p = a.piece_begin[cell_a]; p < a.piece_begin[cell_a + 1]; ++p)
      for (const Vec3Of<T>& corner : states[body_a].corners[p])
        if (node_inside(box, corner)) return true;
  }
  return false;
}

template <typename T>
void NodePlaneStageOf<T>::run_cells(const FfdModels<T>& models, const FfdStates<T>& states,
                                    const std::vector<ElementPair>& candidates, bool first_only,
                                    std::vector<ElementPair>& out) {
  SeenPairs seen(models.size());
  for (const ElementPair& c : candidates) {
    if (first_only && seen.seen(c.body_a, c.body_b)) continue;
    if (any_corner_inside(models, states, c.body_a, c.a, c.body_b, c.b) ||
        any_corner_inside(models, states, c.body_b, c.b, c.body_a, c.a)) {
      seen.mark(c.body_a, c.body_b);
      out.push_back(c);
    }
  }
}

template class NodePlaneStageOf<double>;
template class NodePlaneStageOf<float>;

}  // namespace contactcheck
