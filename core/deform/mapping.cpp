#include "core/deform/mapping.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/deform/mapping.cpp"
#include <hwy/foreach_target.h>
// clang-format off: highway.h must follow foreach_target.h
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The operations of blend() in the same order, lane by lane: mul, mul, add, never fused.
template <class V>
HWY_INLINE V blend_lanes(V a, V b, V w, V one_minus_w) {
  return hn::Add(hn::Mul(a, one_minus_w), hn::Mul(b, w));
}

template <class D>
struct LocalLanes {
  hn::Vec<D> s, t, u, one_minus_s, one_minus_t, one_minus_u;
};

template <class D>
HWY_INLINE hn::Vec<D> map_axis(D d, const double* corners, const LocalLanes<D>& w) {
  const auto along_s = [&](int low) HWY_ATTR {
    return blend_lanes(hn::Set(d, corners[low]), hn::Set(d, corners[low + 1]), w.s, w.one_minus_s);
  };
  const auto near_u = blend_lanes(along_s(0), along_s(2), w.t, w.one_minus_t);
  const auto far_u = blend_lanes(along_s(4), along_s(6), w.t, w.one_minus_t);
  return blend_lanes(near_u, far_u, w.u, w.one_minus_u);
}

struct CellBatch {
  double corners[3][8];           // per axis
  const double* local[3];         // cell-sorted local coordinates of the cell's vertices
  const std::uint32_t* vertices;  // where each goes
  std::size_t count;
};

// One full vector of vertices. `lanes` of them are stored: the rest repeat valid memory's values.
template <class D>
HWY_INLINE void map_lanes(D d, const CellBatch& batch, const double* s, const double* t,
                          const double* u, std::size_t first, std::size_t lanes, Vec3* out) {
  const auto one = hn::Set(d, 1.0);
  LocalLanes<D> w;
  w.s = hn::LoadU(d, s);
  w.t = hn::LoadU(d, t);
  w.u = hn::LoadU(d, u);
  w.one_minus_s = hn::Sub(one, w.s);
  w.one_minus_t = hn::Sub(one, w.t);
  w.one_minus_u = hn::Sub(one, w.u);
  HWY_ALIGN double mapped[3][hn::MaxLanes(d)];
  for (int k = 0; k < 3; ++k) hn::Store(map_axis(d, batch.corners[k], w), d, mapped[k]);
  for (std::size_t i = 0; i < lanes; ++i) {
    double* target = out[batch.vertices[first + i]].data();
    for (int k = 0; k < 3; ++k) target[k] = mapped[k][i];
  }
}

void map_cell(const CellBatch& batch, Vec3* out) {
  const hn::ScalableTag<double> d;
  const std::size_t n = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + n <= batch.count; i += n) {
    map_lanes(d, batch, batch.local[0] + i, batch.local[1] + i, batch.local[2] + i, i, n, out);
  }
  if (i == batch.count) return;
  HWY_ALIGN double rest[3][hn::MaxLanes(d)] = {};
  for (int k = 0; k < 3; ++k)
    for (std::size_t j = i; j < batch.count; ++j) rest[k][j - i] = batch.local[k][j];
  map_lanes(d, batch, rest[0], rest[1], rest[2], i, batch.count - i, out);
}

void map_all(const Lattice& lattice, const Embedding& embedding, const Vec3* nodes, Vec3* out) {
  for (std::size_t cell = 0; cell < lattice.cells.size(); ++cell) {
    const std::uint32_t begin = embedding.cell_begin[cell];
    CellBatch batch;
    batch.count = embedding.cell_begin[cell + 1] - begin;
    if (batch.count == 0) continue;
    for (int c = 0; c < 8; ++c)
      for (int k = 0; k < 3; ++k) batch.corners[k][c] = nodes[lattice.cell_nodes[cell][c]][k];
    for (int k = 0; k < 3; ++k) batch.local[k] = embedding.sorted_local[k].data() + begin;
    batch.vertices = embedding.cell_order.data() + begin;
    map_cell(batch, out);
  }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contactcheck {
HWY_EXPORT(map_all);
HWY_EXPORT(target_name);

const char* simd_target() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

void map_vertices(const Lattice& lattice, const Embedding& embedding, std::span<const Vec3> nodes,
                  std::span<Vec3> out) {
  HWY_DYNAMIC_DISPATCH(map_all)(lattice, embedding, nodes.data(), out.data());
}

}  // namespace contactcheck
#endif
