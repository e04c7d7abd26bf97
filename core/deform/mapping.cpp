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

template <typename T>
struct CellBatch {
  T corners[3][8];                // per axis
  const T* local[3];              // cell-sorted local coordinates of the cell's vertices
  const std::uint32_t* vertices;  // where each goes
  std::size_t count;
};

// Maps one vector of vertices. The last vector of a cell runs on into its neighbour's coordinates,
// or into the padding at the end (embedding.h): those lanes are not stored.
// (Three plain stores per vertex beat StoreInterleaved3 and copies: Highway 1.0.3, November 2026.)
template <class D>
HWY_INLINE void map_lanes(D d, const CellBatch<hn::TFromD<D>>& batch, std::size_t first,
                          std::size_t lanes, Vec3Of<hn::TFromD<D>>* out) {
  using T = hn::TFromD<D>;
  const auto w =
      local_lanes(d, hn::LoadU(d, batch.local[0] + first), hn::LoadU(d, batch.local[1] + first),
                  hn::LoadU(d, batch.local[2] + first));
  HWY_ALIGN T mapped[3][hn::MaxLanes(d)];
  for (int k = 0; k < 3; ++k) hn::Store(map_axis(d, batch.corners[k], w), d, mapped[k]);
  for (std::size_t i = 0; i < lanes; ++i) {
    T* target = out[batch.vertices[first + i]].data();
    for (int k = 0; k < 3; ++k) target[k] = mapped[k][i];
  }
}

template <typename T>
HWY_INLINE void map_cell(const CellBatch<T>& batch, Vec3Of<T>* out) {
  const hn::CappedTag<T, kEmbeddingPadding> d;
  const std::size_t n = hn::Lanes(d);
  std::size_t first = 0;
  for (; first + n <= batch.count; first += n) map_lanes(d, batch, first, n, out);
  if (first < batch.count) map_lanes(d, batch, first, batch.count - first, out);
}

template <typename T>
HWY_INLINE void map_all(const Lattice& lattice, const Embedding& embedding,
                        const std::array<std::vector<T>, 3>& local, const Vec3Of<T>* nodes,
                        Vec3Of<T>* out) {
  for (std::size_t cell = 0; cell < lattice.cells.size(); ++cell) {
    const std::uint32_t begin = embedding.cell_begin[cell];
    CellBatch<T> batch;
    batch.count = embedding.cell_begin[cell + 1] - begin;
    if (batch.count == 0) continue;
    gather_corners(lattice.cell_nodes[cell], nodes, batch.corners);
    for (int k = 0; k < 3; ++k) batch.local[k] = local[k].data() + begin;
    batch.vertices = embedding.cell_order.data() + begin;
    map_cell(batch, out);
  }
}

// The lanes are the corners of one box.
template <typename T>
HWY_INLINE void map_all_boxes(const Lattice& lattice, std::span<const LocalBoxOf<T>> boxes,
                              const Vec3Of<T>* nodes, CornersOf<T>* out) {
  const hn::CappedTag<T, 8> d;
  const std::size_t n = hn::Lanes(d);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    T corners[3][8];
    gather_corners(lattice.cell_nodes[boxes[i].home], nodes, corners);
    HWY_ALIGN T sides[3][8];
    for (int c = 0; c < 8; ++c)
      for (int k = 0; k < 3; ++k)
        sides[k][c] = (c >> k & 1) ? boxes[i].local.hi[k] : boxes[i].local.lo[k];
    for (std::size_t first = 0; first < 8; first += n) {
      const auto w = local_lanes(d, hn::Load(d, sides[0] + first), hn::Load(d, sides[1] + first),
                                 hn::Load(d, sides[2] + first));
      HWY_ALIGN T mapped[3][hn::MaxLanes(d)];
      for (int k = 0; k < 3; ++k) hn::Store(map_axis(d, corners[k], w), d, mapped[k]);
      for (std::size_t c = 0; c < n; ++c)
        for (int k = 0; k < 3; ++k) out[i][first + c][k] = mapped[k][c];
    }
  }
}

void map_doubles(const Lattice& lattice, const Embedding& embedding, const Vec3* nodes, Vec3* out) {
  map_all(lattice, embedding, embedding.sorted_local, nodes, out);
}
void map_singles(const Lattice& lattice, const Embedding& embedding, const SingleLocal& local,
                 const Vec3f* nodes, Vec3f* out) {
  map_all(lattice, embedding, local, nodes, out);
}
void map_double_boxes(const Lattice& lattice, std::span<const LocalBox> boxes, const Vec3* nodes,
                      Corners* out) {
  map_all_boxes(lattice, boxes, nodes, out);
}
void map_single_boxes(const Lattice& lattice, std::span<const LocalBoxOf<float>> boxes,
                      const Vec3f* nodes, CornersOf<float>* out) {
  map_all_boxes(lattice, boxes, nodes, out);
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contactcheck {
HWY_EXPORT(map_doubles);
HWY_EXPORT(map_singles);
HWY_EXPORT(map_double_boxes);
HWY_EXPORT(map_single_boxes);
HWY_EXPORT(target_name);

const char* simd_target() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

void map_vertices(const Lattice& lattice, const Embedding& embedding, std::span<const Vec3> nodes,
                  std::span<Vec3> out) {
  HWY_DYNAMIC_DISPATCH(map_doubles)(lattice, embedding, nodes.data(), out.data());
}

void map_vertices(const Lattice& lattice, const Embedding& embedding, const SingleLocal& local,
                  std::span<const Vec3f> nodes, std::span<Vec3f> out) {
  HWY_DYNAMIC_DISPATCH(map_singles)(lattice, embedding, local, nodes.data(), out.data());
}

void map_boxes(const Lattice& lattice, std::span<const LocalBox> boxes, std::span<const Vec3> nodes,
               std::span<Corners> out) {
  HWY_DYNAMIC_DISPATCH(map_double_boxes)(lattice, boxes, nodes.data(), out.data());
}

void map_boxes(const Lattice& lattice, std::span<const LocalBoxOf<float>> boxes,
               std::span<const Vec3f> nodes, std::span<CornersOf<float>> out) {
  HWY_DYNAMIC_DISPATCH(map_single_boxes)(lattice, boxes, nodes.data(), out.data());
}

}  // namespace contactcheck
#endif
