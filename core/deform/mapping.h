// The one mapping from deformed lattice nodes to deformed vertices: trilinear, IEEE double, a fixed
// order of operations, nothing fused. Every detector and the oracle judge exactly these doubles.
//
// Guarantees: local coordinates 0 and 1 reproduce node bits exactly; all batch versions give the
// bits of map_point on every instruction set (test: Mapping.BatchGivesTheBitsOfThePointVersion).
#pragma once

#include <cstdint>
#include <span>

#include "core/deform/embedding.h"
#include "core/deform/lattice.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// The canonical blend of two values: a * (1 - w) + b * w, in this order.
inline double blend(double a, double b, double w) { return a * (1.0 - w) + b * w; }

/// Maps local coordinates by the eight corners of a cell: first along s, then t, then u.
inline Vec3 map_point(const Corners& c, const Vec3& local) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const double x00 = blend(c[0][k], c[1][k], local.x());
    const double x10 = blend(c[2][k], c[3][k], local.x());
    const double x01 = blend(c[4][k], c[5][k], local.x());
    const double x11 = blend(c[6][k], c[7][k], local.x());
    out[k] = blend(blend(x00, x10, local.y()), blend(x01, x11, local.y()), local.z());
  }
  return out;
}

/// Maps every vertex of a mesh. `nodes`: the lattice's deformed nodes; `out`: one per vertex, in
/// the order of the mesh. SIMD with run-time dispatch.
void map_vertices(const Lattice& lattice, const Embedding& embedding, std::span<const Vec3> nodes,
                  std::span<Vec3> out);

/// A box in local coordinates of a kept cell.
struct LocalBox {
  std::uint32_t home = 0;
  Aabb local;
};

/// Maps the eight corners of every box, with the bits of map_point. `out`: one per box. SIMD with
/// run-time dispatch.
void map_boxes(const Lattice& lattice, std::span<const LocalBox> boxes, std::span<const Vec3> nodes,
               std::span<Corners> out);

/// Name of the instruction set that map_vertices runs on here: "AVX3", "AVX2", "SSE4", ...
const char* simd_target();

/// Bound on |computed - exact| per coordinate of map_point, given the largest |coordinate| of the
/// nodes, for local coordinates in [0, 1] known exactly.
/// Each blend adds at most 3 rounding steps of 2^-53 relative to its inputs (1 - w, the two
/// products, their sum: (1 + e)^3 - 1 < 3.1 e); three nested blends: below 10 * 2^-53. The constant
/// covers the 14 products that may underflow, each by at most 2^-1075.
inline double mapping_error_bound(double largest_coordinate) {
  return 10.0 * 0x1p-53 * largest_coordinate + 0x1p-1069;
}

}  // namespace contactcheck
