// The free-form-deformation lattice of one body, at rest.
// Source: Sederberg & Parry, Free-Form Deformation of Solid Geometric Models, SIGGRAPH 1986, in its
// trilinear form; only cells that contain surface are kept (Jeon et al. 2013).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "core/types/mesh.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Position of a cell or node in the grid.
using GridIndex = std::array<std::uint32_t, 3>;

/// Orders by z, then y, then x.
inline bool grid_before(const GridIndex& a, const GridIndex& b) {
  return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
}

/// The eight corners of a cell or box. Corner c lies at the high end of axis k when bit k of c is
/// set.
template <typename T>
using CornersOf = std::array<Vec3Of<T>, 8>;
using Corners = CornersOf<double>;
using CornerIds = std::array<std::uint32_t, 8>;

struct Lattice {
  /// Grid lines per axis, strictly increasing, at least two. A cell's closed box at rest runs
  /// between neighbouring lines: these doubles, not origin + i * h, are the definition.
  std::array<std::vector<double>, 3> lines;
  std::vector<GridIndex> cells;       ///< kept cells, ascending in (z, y, x)
  std::vector<GridIndex> nodes;       ///< nodes of kept cells, ascending in (z, y, x)
  std::vector<CornerIds> cell_nodes;  ///< per kept cell: indices into `nodes`

  /// Index of the first kept cell that is not before `at` (grid_before), or cells.size().
  std::size_t first_cell_from(const GridIndex& at) const;
  Vec3 rest_node(std::uint32_t node) const;
  std::vector<Vec3> rest_nodes() const;
  Aabb cell_box(std::uint32_t cell) const;
};

/// True if two kept cells have a common node; a cell shares its own.
inline bool share_node(const Lattice& lattice, std::uint32_t a, std::uint32_t b) {
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t p = lattice.cells[a][k], q = lattice.cells[b][k];
    if (p > q + 1 || q > p + 1) return false;
  }
  return true;
}

/// Number of cells wanted per axis.
struct Resolution {
  std::uint32_t x = 1, y = 1, z = 1;
};

/// Limit along one axis of a regular lattice: 2^24 + 1 grid lines take 128 MiB.
inline constexpr std::uint32_t kMostCellsOfAxis = std::uint32_t{1} << 24;

/// @throws InputError, naming axis and number, for more than kMostCellsOfAxis
void refuse_fine_resolution(const Resolution& resolution);

/// A regular lattice round `mesh`, larger on each side by `padding` (fraction of the largest side;
/// at least 0.001 is taken). Keeps the cells whose closed box meets a triangle, exactly.
/// @pre the mesh has no fatal defect; each resolution is at least 1
/// @throws InputError when the mesh lies too far out for grid lines that differ as doubles, as
/// refuse_fine_resolution() does, and when the kept cells have more nodes than 32 bits can number
Lattice make_lattice(const TriangleMesh& mesh, const Resolution& resolution, double padding);

/// A lattice on given grid lines, with the same cells kept. @pre as Lattice::lines; the mesh lies
/// within them
/// @throws InputError when the kept cells have more nodes than 32 bits can number
Lattice make_lattice_on_lines(const TriangleMesh& mesh, std::array<std::vector<double>, 3> lines);

/// The resolution of near-cubic cells whose lattice keeps a number of cells nearest to `wanted`.
Resolution resolution_for_cells(const TriangleMesh& mesh, std::size_t wanted, double padding);

/// Gathers the eight (deformed) nodes of a cell.
Corners corners_of(const Lattice& lattice, std::uint32_t cell, std::span<const Vec3> nodes);

}  // namespace contactcheck
