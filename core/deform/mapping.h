// The one mapping from deformed lattice nodes to deformed vertices: trilinear, IEEE double, a fixed
// order of operations, nothing fused. Every detector and the oracle judge exactly these doubles.
//
// The same operations on floats are for detectors in single precision, which round nodes and local
// coordinates once and map vertices of their own.
//
// Guarantees: local coordinates 0 and 1 reproduce node bits exactly; all batch versions give the
// bits of map_point on every instruction set (test: Mapping.BatchGivesTheBitsOfThePointVersion).
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "core/deform/embedding.h"
#include "core/deform/lattice.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// The canonical blend of two values: a * (1 - w) + b * w, in this order.
template <typename T>
T blend(T a, T b, T w) {
  return a * (T(1) - w) + b * w;
}

/// Maps local coordinates by the eight corners of a cell: first along s, then t, then u.
template <typename T>
Vec3Of<T> map_point(const CornersOf<T>& c, const Vec3Of<T>& local) {
  Vec3Of<T> out;
  for (int k = 0; k < 3; ++k) {
    const T x00 = blend(c[0][k], c[1][k], local.x());
    const T x10 = blend(c[2][k], c[3][k], local.x());
    const T x01 = blend(c[4][k], c[5][k], local.x());
    const T x11 = blend(c[6][k], c[7][k], local.x());
    out[k] = blend(blend(x00, x10, local.y()), blend(x01, x11, local.y()), local.z());
  }
  return out;
}

/// Maps every vertex of a mesh. `nodes`: the lattice's deformed nodes; `out`: one per vertex, in
/// the order of the mesh. SIMD with run-time dispatch.
void map_vertices(const Lattice& lattice, const Embedding& embedding, std::span<const Vec3> nodes,
                  std::span<Vec3> out);
/// The same in single precision. `local`: single_local(embedding).
void map_vertices(const Lattice& lattice, const Embedding& embedding, const SingleLocal& local,
                  std::span<const Vec3f> nodes, std::span<Vec3f> out);

/// A box in local coordinates of a kept cell.
template <typename T>
struct LocalBoxOf {
  std::uint32_t home = 0;
  AabbOf<T> local;
};
using LocalBox = LocalBoxOf<double>;

/// Maps the eight corners of every box, with the bits of map_point. `out`: one per box. SIMD with
/// run-time dispatch.
void map_boxes(const Lattice& lattice, std::span<const LocalBox> boxes, std::span<const Vec3> nodes,
               std::span<Corners> out);
void map_boxes(const Lattice& lattice, std::span<const LocalBoxOf<float>> boxes,
               std::span<const Vec3f> nodes, std::span<CornersOf<float>> out);

/// Name of the instruction set that map_vertices runs on here: "AVX3", "AVX2", "SSE4", ...
const char* simd_target();

/// Bound on |computed - exact| per coordinate of map_point, given the largest |coordinate| M of the
/// nodes, for local coordinates in [0, 1] known exactly. With u = 2^-53, of floats 2^-24:
///   * A blend a (1 - w) + b w rounds 1 - w, both products and the sum. Each product has at most 3
///     factors 1 + d, |d| <= u, so the blend is wrong by at most ((1 + u)^3 - 1) M < 3.1 u M.
///   * Three nested blends: 3 * 3.1 u M, below 10 u M.
///   * The 14 products of the 7 blends may underflow, each by at most half the smallest positive
///     number. 32 of these numbers cover that.
template <typename T>
T mapping_error_bound(T largest_coordinate) {
  using Limits = std::numeric_limits<T>;
  return T(10) * (Limits::epsilon() / 2) * largest_coordinate + 32 * Limits::denorm_min();
}

}  // namespace contactcheck
