#include "core/deform/lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/deform/grid.h"
#include "core/narrow/triangle_box.h"
#include "core/types/check.h"
#include "core/types/count.h"

namespace contactcheck {
namespace {

// Fraction of the largest side.
constexpr double kLeastPadding = 1e-3;
// Metres, for a mesh at or within a metre of the origin; relative to its coordinates farther out.
constexpr double kPaddingOfPoint = 1e-9;

std::vector<double> grid_lines(double lo, double hi, std::uint32_t cells) {
  std::vector<double> lines(cells + 1);
  for (std::uint32_t i = 0; i <= cells; ++i) {
    const double w = static_cast<double>(i) / cells;
    lines[i] = lo * (1.0 - w) + hi * w;
  }
  lines.back() = hi;
  return lines;
}

// Cells far from the origin may be finer than doubles there, and huge ones may overflow.
void check_lines(const std::vector<double>& lines, int axis) {
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (!(lines[i - 1] < lines[i]) || !std::isfinite(lines[i] - lines[i - 1]))
      throw InputError("the lattice cannot have " + std::to_string(lines.size() - 1) +
                       " cells along axis " + "xyz"[axis] + " between " +
                       std::to_string(lines.front()) + " and " + std::to_string(lines.back()) +
                       ": double precision cannot tell its grid lines apart");
}

std::array<std::vector<double>, 3> make_lines(const TriangleMesh& mesh,
                                              const Resolution& resolution, double padding) {
  const Aabb box = bounding_box(mesh);
  const double largest = box.extent().maxCoeff();
  // A flat mesh still gets cells of positive size, and so does one that is a single point.
  const double pad = largest > 0.0 ? std::max(padding, kLeastPadding) * largest
                                   : kPaddingOfPoint * std::max(1.0, box.hi.cwiseAbs().maxCoeff());
  const std::array<std::uint32_t, 3> cells = {resolution.x, resolution.y, resolution.z};
  std::array<std::vector<double>, 3> lines;
  for (int k = 0; k < 3; ++k) {
    lines[k] = grid_lines(box.lo[k] - pad, box.hi[k] + pad, cells[k]);
    check_lines(lines[k], k);
  }
  return lines;
}

// In the order of the grid, each once. No array is as large as the grid: of long lattices most
// cells are not kept.
void sort_in_grid(std::vector<GridIndex>& list) {
  std::sort(list.begin(), list.end(), grid_before);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

std::vector<GridIndex> kept_cells(const Grid& grid, const TriangleMesh& mesh) {
  std::vector<GridIndex> cells;
  // Every cell that meets a triangle, exactly.
  for (const Triangle& t : mesh.triangles)
    grid.for_cells_meeting({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]},
                           [&](const GridIndex& cell) {
                             cells.push_back(cell);
                             return true;
                           });
  sort_in_grid(cells);
  return cells;
}

void number_nodes(Lattice& lattice) {
  const auto corner = [](const GridIndex& cell, int c) {
    return GridIndex{cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2 & 1)};
  };
  for (const GridIndex& cell : lattice.cells)
    for (int c = 0; c < 8; ++c) lattice.nodes.push_back(corner(cell, c));
  sort_in_grid(lattice.nodes);
  in_32_bits<InputError>(lattice.nodes.size(), "nodes of kept cells");
  for (const GridIndex& cell : lattice.cells) {
    CornerIds ids;
    for (int c = 0; c < 8; ++c)
      ids[c] =
          static_cast<std::uint32_t>(std::lower_bound(lattice.nodes.begin(), lattice.nodes.end(),
                                                      corner(cell, c), grid_before) -
                                     lattice.nodes.begin());
    lattice.cell_nodes.push_back(ids);
  }
}

}  // namespace

std::size_t Lattice::first_cell_from(const GridIndex& at) const {
  return static_cast<std::size_t>(std::lower_bound(cells.begin(), cells.end(), at, grid_before) -
                                  cells.begin());
}

Vec3 Lattice::rest_node(std::uint32_t node) const {
  const GridIndex& g = nodes[node];
  return {lines[0][g[0]], lines[1][g[1]], lines[2][g[2]]};
}

std::vector<Vec3> Lattice::rest_nodes() const {
  std::vector<Vec3> out(nodes.size());
  for (std::uint32_t n = 0; n < nodes.size(); ++n) out[n] = rest_node(n);
  return out;
}

Aabb Lattice::cell_box(std::uint32_t cell) const {
  const GridIndex& g = cells[cell];
  Aabb box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = lines[k][g[k]];
    box.hi[k] = lines[k][g[k] + 1];
  }
  return box;
}

void refuse_fine_resolution(const Resolution& resolution) {
  const std::array<std::uint32_t, 3> cells = {resolution.x, resolution.y, resolution.z};
  for (std::size_t k = 0; k < 3; ++k)
    if (cells[k] > kMostCellsOfAxis)
      throw InputError("the lattice cannot have " + std::to_string(cells[k]) +
                       " cells along axis " + "xyz"[k] + ": at most " +
                       std::to_string(kMostCellsOfAxis) + " are made");
}

Lattice make_lattice(const TriangleMesh& mesh, const Resolution& resolution, double padding) {
  CONTACTCHECK_INVARIANT(resolution.x > 0 && resolution.y > 0 && resolution.z > 0,
                         "a lattice has at least one cell per axis");
  refuse_fine_resolution(resolution);
  return make_lattice_on_lines(mesh, make_lines(mesh, resolution, padding));
}

Lattice make_lattice_on_lines(const TriangleMesh& mesh, std::array<std::vector<double>, 3> lines) {
  Lattice lattice;
  lattice.lines = std::move(lines);
  const Grid grid(lattice.lines);
  lattice.cells = kept_cells(grid, mesh);
  number_nodes(lattice);
  return lattice;
}

Resolution resolution_for_cells(const TriangleMesh& mesh, std::size_t wanted, double padding) {
  const Vec3 extent = bounding_box(mesh).extent();
  const double largest = extent.maxCoeff();
  const auto resolution_at = [&](int divisions) {
    const auto cells = [&](double side) {
      return static_cast<std::uint32_t>(
          side > 0.0 ? std::max(1.0, std::round(side / largest * divisions)) : 1.0);
    };
    return Resolution{cells(extent.x()), cells(extent.y()), cells(extent.z())};
  };
  Resolution best;
  std::size_t best_gap = SIZE_MAX;
  // Kept cells grow about quadratically with the divisions: stop once far beyond the wish.
  for (int divisions = 1; divisions <= 256; ++divisions) {
    const Resolution r = resolution_at(divisions);
    const auto lines = make_lines(mesh, r, padding);
    const std::size_t kept = kept_cells(Grid(lines), mesh).size();
    const std::size_t gap = kept > wanted ? kept - wanted : wanted - kept;
    if (gap < best_gap) {
      best_gap = gap;
      best = r;
    }
    if (gap == 0 || kept > 2 * wanted) break;
  }
  return best;
}

Corners corners_of(const Lattice& lattice, std::uint32_t cell, std::span<const Vec3> nodes) {
  Corners corners;
  const CornerIds& ids = lattice.cell_nodes[cell];
  for (int c = 0; c < 8; ++c) corners[c] = nodes[ids[c]];
  return corners;
}

}  // namespace contactcheck
