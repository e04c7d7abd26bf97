#include "core/deform/embedding.h"

#include <algorithm>
#include <numeric>

#include "core/deform/grid.h"
#include "core/types/check.h"
#include "core/types/count.h"

namespace contactcheck {
namespace {

// v and both lines are doubles with lo <= v <= hi: v - lo <= hi - lo survives rounding, so the
// quotient lies in [0, 1]; it is 0 and 1 exactly on the lines.
double local_coordinate(double v, double lo, double hi) { return (v - lo) / (hi - lo); }

}  // namespace

void sort_by_cell(std::size_t cells, Embedding& out) {
  out.cell_begin.assign(cells + 1, 0);
  for (std::uint32_t cell : out.home_cell) ++out.cell_begin[cell + 1];
  std::partial_sum(out.cell_begin.begin(), out.cell_begin.end(), out.cell_begin.begin());
  out.cell_order.resize(out.home_cell.size());
  std::vector<std::uint32_t> next(out.cell_begin.begin(), out.cell_begin.end() - 1);
  for (std::uint32_t v = 0; v < out.home_cell.size(); ++v) {
    out.cell_order[next[out.home_cell[v]]++] = v;
  }
  for (int k = 0; k < 3; ++k) {
    out.sorted_local[k].assign(out.cell_order.size() + kEmbeddingPadding, 0.0);
    for (std::size_t i = 0; i < out.cell_order.size(); ++i)
      out.sorted_local[k][i] = out.local[out.cell_order[i]][k];
  }
}

SingleLocal single_local(const Embedding& embedding) {
  SingleLocal out;
  for (int k = 0; k < 3; ++k)
    for (double x : embedding.sorted_local[k]) out[k].push_back(static_cast<float>(x));
  return out;
}

Embedding embed(const TriangleMesh& mesh, const Lattice& lattice) {
  const Grid grid(lattice.lines);
  const auto number = [&](const GridIndex& cell) {
    const std::size_t found = lattice.first_cell_from(cell);
    CONTACTCHECK_INVARIANT(found < lattice.cells.size() && lattice.cells[found] == cell,
                           "cells of vertices and triangles are kept");
    return static_cast<std::uint32_t>(found);
  };
  Embedding out;
  out.home_cell.resize(mesh.vertices.size());
  out.local.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    const std::uint32_t cell = number(grid.cell_of(p));
    const Aabb box = lattice.cell_box(cell);
    out.home_cell[v] = cell;
    for (int k = 0; k < 3; ++k) out.local[v][k] = local_coordinate(p[k], box.lo[k], box.hi[k]);
  }

  out.label_begin.push_back(0);
  for (const Triangle& t : mesh.triangles) {
    const TrianglePoints points = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    grid.for_cells_meeting(points, [&](const GridIndex& cell) {
      out.label_cells.push_back(number(cell));
      return true;
    });
    out.label_begin.push_back(
        in_32_bits<InputError>(out.label_cells.size(), "cells in the labels of triangles"));
  }
  sort_by_cell(lattice.cells.size(), out);
  return out;
}

}  // namespace contactcheck
