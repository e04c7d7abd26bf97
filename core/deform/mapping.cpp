#include "core/deform/mapping.h"

#include <cstdint>

#include "core/types/vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/deform/mapping.cpp"
#include <hwy/foreach_target.h>
// clang-format off: highway.h must follow foreach_target.h
#include <hwy/highway.h>
// clang-format on

#include "core/deform/mapping-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct CellBatch {
  double corners[3][8];           // per axis
  const double* local[3];         // cell-sorted local coordinates of the cell's vertices
  const std::uint32_t* vertices;  // where each goes
  std::size_t count;
};

// Maps one vector of vertices. The last vector of a cell runs on into its neighbour's coordinates,
// or into the padding at the end (embedding.h): those lanes are not stored.
// (Three plain stores per vertex beat StoreInterleaved3 and copies: Highway 1.0.3, November 2026.)
template <class D>
HWY_INLINE void map_lanes(D d, const CellBatch& batch, std::size_t first, std::size_t lanes,
                          Vec3* out) {
  const auto w =
      local_lanes(d, hn::LoadU(d, batch.local[0] + first), hn::LoadU(d, batch.local[1] + first),
                  hn::LoadU(d, batch.local[2] + first));
  HWY_ALIGN double mapped[3][hn::MaxLanes(d)];
  for (int k = 0; k < 3; ++k) hn::Store(map_axis(d, batch.corners[k], w), d, mapped[k]);
  for (std::size_t i = 0; i < lanes; ++i) {
    double* target = out[batch.vertices[first + i]].data();
    for (int k = 0; k < 3; ++k) target[k] = mapped[k][i];
  }
}

void map_cell(const CellBatch& batch, Vec3* out) {
  const hn::CappedTag<double, kEmbeddingPadding> d;
  const std::size_t n = hn::Lanes(d);
  std::size_t first = 0;
  for (; first + n <= batch.count; first += n) map_lanes(d, batch, first, n, out);
  if (first < batch.count) map_lanes(d, batch, first, batch.count - first, out);
}

void map_all(const Lattice& lattice, const Embedding& embedding, const Vec3* nodes, Vec3* out) {
  for (std::size_t cell = 0; cell < lattice.cells.size(); ++cell) {
    const std::uint32_t begin = embedding.cell_begin[cell];
    CellBatch batch;
    batch.count = embedding.cell_begin[cell + 1] - begin;
    if (batch.count == 0) continue;
    gather_corners(lattice.cell_nodes[cell], nodes, batch.corners);
    for (int k = 0; k < 3; ++k) batch.local[k] = embedding.sorted_local[k].data() + begin;
    batch.vertices = embedding.cell_order.data() + begin;
    map_cell(batch, out);
  }
}

// The lanes are the corners of one box.
void map_all_boxes(const Lattice& lattice, const LocalBox* boxes, std::size_t count,
                   const Vec3* nodes, Corners* out) {
  const hn::CappedTag<double, 8> d;
  const std::size_t n = hn::Lanes(d);
  for (std::size_t i = 0; i < count; ++i) {
    double corners[3][8];
    gather_corners(lattice.cell_nodes[boxes[i].home], nodes, corners);
    HWY_ALIGN double sides[3][8];
    for (int c = 0; c < 8; ++c)
      for (int k = 0; k < 3; ++k)
        sides[k][c] = (c >> k & 1) ? boxes[i].local.hi[k] : boxes[i].local.lo[k];
    for (std::size_t first = 0; first < 8; first += n) {
      const auto w = local_lanes(d, hn::Load(d, sides[0] + first), hn::Load(d, sides[1] + first),
                                 hn::Load(d, sides[2] + first));
      HWY_ALIGN double mapped[3][hn::MaxLanes(d)];
      for (int k = 0; k < 3; ++k) hn::Store(map_axis(d, corners[k], w), d, mapped[k]);
      for (std::size_t c = 0; c < n; ++c)
        for (int k = 0; k < 3; ++k) out[i][first + c][k] = mapped[k][c];
    }
  }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contactcheck {
HWY_EXPORT(map_all);
HWY_EXPORT(map_all_boxes);
HWY_EXPORT(target_name);

const char* simd_target() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

void map_vertices(const Lattice& lattice, const Embedding& embedding, std::span<const Vec3> nodes,
                  std::span<Vec3> out) {
  HWY_DYNAMIC_DISPATCH(map_all)(lattice, embedding, nodes.data(), out.data());
}

void map_boxes(const Lattice& lattice, std::span<const LocalBox> boxes, std::span<const Vec3> nodes,
               std::span<Corners> out) {
  HWY_DYNAMIC_DISPATCH(map_all_boxes)
  (lattice, boxes.data(), boxes.size(), nodes.data(), out.data());
}

}  // namespace contactcheck
#endif
