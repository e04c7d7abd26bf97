#include "core/detect/element_stages.h"

#include <type_traits>

#include "core/detect/seen_pairs.h"
#include "core/narrow/adjacent_triangles.h"
#include "core/narrow/triangle_triangle.h"

namespace contactcheck {
namespace {

template <typename T>
TrianglePointsOf<T> points_of(const FfdModelOf<T>& model,
                              std::type_identity_t<std::span<const Vec3Of<T>>> vertices,
                              std::uint32_t t) {
  const Triangle& tri = model.shape->mesh.triangles[t];
  return {vertices[tri[0]], vertices[tri[1]], vertices[tri[2]]};
}

}  // namespace

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
    const NodeDepth penetration = node_depth(box, p);
    if (penetration.outward.isZero(0.0)) continue;
    for_cells_of_probe(models[hit.body_a], kVolume, hit.probe, [&](std::uint32_t cell) {
      out.push_back(
          {{hit.body_a, hit.body_b, cell, hit.cell_b}, penetration.depth, -penetration.outward});
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

template <typename T>
void TriangleStageOf<T>::begin_frame(const FfdModels<T>& models,
                                     const std::vector<std::span<const Vec3Of<T>>>& vertices) {
  vertices_ = vertices;
  boxes_.resize(models.size());
  for (std::size_t body = 0; body < models.size(); ++body) {
    boxes_[body].resize(models[body].piece_begin.size() - 1);
    for (CellBoxes& cell : boxes_[body]) cell.known = false;
  }
}

template <typename T>
const typename TriangleStageOf<T>::CellBoxes& TriangleStageOf<T>::boxes(const FfdModels<T>& models,
                                                                        std::uint32_t body,
                                                                        std::uint32_t cell) {
  CellBoxes& out = boxes_[body][cell];
  if (out.known) return out;
  const auto row = models[body].triangles.row(cell);
  out.whole = AabbOf<T>{};
  out.triangles.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    AabbOf<T> box;
    for (const Vec3Of<T>& p : points_of(models[body], vertices_[body], row[i])) box.extend(p);
    out.triangles[i] = box;
    out.whole.extend(box);
  }
  out.known = true;
  return out;
}

template <typename T>
void TriangleStageOf<T>::collect(const FfdModels<T>& models, std::uint32_t body, std::uint32_t cell,
                                 const AabbOf<T>& region, std::vector<std::uint32_t>& out) {
  out.clear();
  const CellBoxes& cell_boxes = boxes(models, body, cell);
  for (std::uint32_t i = 0; i < cell_boxes.triangles.size(); ++i)
    if (cell_boxes.triangles[i].overlaps(region)) out.push_back(i);
}

template <typename T>
bool TriangleStageOf<T>::test_pair(const FfdModels<T>& models, const ElementPair& cells,
                                   bool first_only, std::vector<ElementPair>& out) {
  const CellBoxes& a = boxes(models, cells.body_a, cells.a);
  const CellBoxes& b = boxes(models, cells.body_b, cells.b);
  if (!a.whole.overlaps(b.whole)) return false;
  collect(models, cells.body_a, cells.a, b.whole, near_a_);
  collect(models, cells.body_b, cells.b, a.whole, near_b_);
  const auto row_a = models[cells.body_a].triangles.row(cells.a);
  const auto row_b = models[cells.body_b].triangles.row(cells.b);
  const bool own = cells.body_a == cells.body_b, within = own && cells.a == cells.b;
  const std::vector<Triangle>& linked = models[cells.body_a].shape->linked();
  bool any = false;
  for (std::uint32_t i : near_a_) {
    const TrianglePointsOf<T> p =
        points_of(models[cells.body_a], vertices_[cells.body_a], row_a[i]);
    for (std::uint32_t j : near_b_) {
      if (!a.triangles[i].overlaps(b.triangles[j])) continue;
      // A triangle may be in several cells.
      if ((within && j <= i) || (own && row_a[i] == row_b[j])) continue;
      const TrianglePointsOf<T> q =
          points_of(models[cells.body_b], vertices_[cells.body_b], row_b[j]);
      if (own ? !meet_beyond_shared(shared_corners(linked[row_a[i]], linked[row_b[j]]), p, q)
              : !triangles_intersect(p, q))
        continue;
      out.push_back({cells.body_a, cells.body_b, row_a[i], row_b[j]});
      if (first_only) return true;
      any = true;
    }
  }
  return any;
}

template <typename T>
void TriangleStageOf<T>::run(const FfdModels<T>& models, const std::vector<ElementPair>& candidates,
                             bool first_only, std::vector<ElementPair>& out) {
  SeenPairs seen(models.size());
  for (const ElementPair& c : candidates) {
    if (first_only && seen.seen(c.body_a, c.body_b)) continue;
    if (test_pair(models, c, first_only, out)) seen.mark(c.body_a, c.body_b);
  }
}

template <typename T>
void TriangleStageOf<T>::run_within_cells(const FfdModels<T>& models, std::uint32_t body,
                                          std::vector<ElementPair>& out) {
  for (std::uint32_t cell = 0; cell + 1 < models[body].piece_begin.size(); ++cell)
    test_pair(models, {body, body, cell, cell}, false, out);
}

template class TriangleStageOf<double>;
template class TriangleStageOf<float>;

}  // namespace contactcheck
