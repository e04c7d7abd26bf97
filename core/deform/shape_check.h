// Checks that a shape from outside satisfies what Lattice and Embedding promise.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/deform/grid.h"

namespace contactcheck {

namespace shape_check_detail {

/// Tolerance of a local coordinate against its position divided by the cell's side: a few roundings
/// of numbers in [0, 1]. Detectors allow more for a vertex at rest (embedded_patch.h).
inline constexpr double kLocalTolerance = 0x1p-50;

inline bool ascending_in_grid(const std::vector<GridIndex>& indices) {
  const auto not_before = [](const GridIndex& a, const GridIndex& b) { return !grid_before(a, b); };
  return std::adjacent_find(indices.begin(), indices.end(), not_before) == indices.end();
}

inline std::string lines_fault(const Lattice& lattice) {
  for (int k = 0; k < 3; ++k) {
    const std::vector<double>& lines = lattice.lines[k];
    const std::string axis = "axis " + std::to_string(k);
    if (lines.size() < 2) return axis + " of the lattice has fewer than two lines";
    if (std::adjacent_find(lines.begin(), lines.end(), std::greater_equal<>()) != lines.end()) {
      return "the lattice lines of " + axis + " do not increase";
    }
    const auto no_width = [](double a, double b) { return !std::isfinite(b - a); };
    if (std::adjacent_find(lines.begin(), lines.end(), no_width) != lines.end())
      return "two lattice lines of " + axis + " are farther apart than the largest double";
  }
  return "";
}

/// The indices of `list` lie in the grid (`beyond_last` positions fewer than lines) and ascend.
inline std::string grid_fault(const Lattice& lattice, const std::vector<GridIndex>& list,
                              std::size_t fewer, const std::string& what) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (list[i][k] >= lattice.lines[k].size() - fewer) {
        return what + " " + std::to_string(i) + " lies outside the grid";
      }
    }
  }
  return ascending_in_grid(list) ? "" : "the lattice " + what + "s do not ascend in (z, y, x)";
}

/// Each cell names the nodes at its corners, and each node belongs to a cell.
inline std::string cell_nodes_fault(const Lattice& lattice) {
  std::vector<bool> used(lattice.nodes.size(), false);
  for (std::size_t i = 0; i < lattice.cells.size(); ++i) {
    const GridIndex& cell = lattice.cells[i];
    for (std::uint32_t c = 0; c < 8; ++c) {
      const std::uint32_t node = lattice.cell_nodes[i][c];
      const GridIndex corner = {cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2 & 1)};
      if (node >= used.size() || lattice.nodes[node] != corner) {
        return "corner " + std::to_string(c) + " of cell " + std::to_string(i) +
               " is not the node there";
      }
      used[node] = true;
    }
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused == used.end()) return "";
  return "node " + std::to_string(unused - used.begin()) + " belongs to no cell";
}

inline std::string homes_fault(const TriangleMesh& mesh, const Lattice& lattice,
                               const Embedding& embedding) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::uint32_t cell = embedding.home_cell[v];
    if (cell >= lattice.cells.size() || !lattice.cell_box(cell).contains(mesh.vertices[v])) {
      return "vertex " + std::to_string(v) + " does not lie in its home cell";
    }
    const Vec3& local = embedding.local[v];
    if ((local.array() < 0.0).any() || (local.array() > 1.0).any()) {
      return "a local coordinate of vertex " + std::to_string(v) + " is outside [0, 1]";
    }
    const Aabb box = lattice.cell_box(cell);
    const Vec3 place = (mesh.vertices[v] - box.lo).cwiseQuotient(box.extent());
    if (((local - place).array().abs() > kLocalTolerance).any()) {
      return "the local coordinates of vertex " + std::to_string(v) +
             " are not those of its position in its home cell";
    }
  }
  return "";
}

inline std::string cell_name(const GridIndex& at) {
  return "(" + std::to_string(at[0]) + ", " + std::to_string(at[1]) + ", " + std::to_string(at[2]) +
         ")";
}

/// The label of each triangle names the cells that it meets, all of which are kept.
inline std::string labels_fault(const TriangleMesh& mesh, const Lattice& lattice,
                                const Embedding& embedding) {
  const std::size_t cells = lattice.cells.size();
  const std::vector<std::uint32_t>& begin = embedding.label_begin;
  if (begin.front() != 0 || begin.back() != embedding.label_cells.size() ||
      std::adjacent_find(begin.begin(), begin.end(), std::greater_equal<>()) != begin.end()) {
    return "the label starts do not ascend from 0 to the number of label cells";
  }
  const Grid grid(lattice.lines);
  for (std::uint32_t t = 0; t + 1 < begin.size(); ++t) {
    const auto label = embedding.cells_of_triangle(t);
    if (label.back() >= cells ||
        std::adjacent_find(label.begin(), label.end(), std::greater_equal<>()) != label.end()) {
      return "the label of triangle " + std::to_string(t) + " is not an ascending list of cells";
    }
    std::string fault;
    std::size_t named = 0;
    const Triangle& corners = mesh.triangles[t];
    grid.for_cells_meeting(
        {mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]},
        [&](const GridIndex& cell) {
          if (named < label.size() && lattice.cells[label[named]] == cell) return ++named, true;
          const std::size_t at = lattice.first_cell_from(cell);
          const bool kept = at < lattice.cells.size() && lattice.cells[at] == cell;
          fault = "triangle " + std::to_string(t) + " meets cell " + cell_name(cell) +
                  (kept ? ", which its label does not name" : ", which is not kept");
          return false;
        });
    if (fault.empty() && named < label.size())
      fault = "the label of triangle " + std::to_string(t) + " names cell " +
              cell_name(lattice.cells[label[named]]) + ", which it does not meet";
    if (!fault.empty()) return fault;
  }
  return "";
}

}  // namespace shape_check_detail

/// The first broken promise of a shape, as the end of a sentence; empty for a good shape. Checks
/// the mesh (by shape.topology), the lattice, home cells, local coordinates and labels (against the
/// vertices, exactly), not the arrays derived from them.
/// @pre topology belongs to the mesh; cell_nodes, home_cell, local and label_begin have one entry
///      per cell, vertex, vertex and triangle + 1
inline std::string shape_fault(const BodyShape& shape) {
  using namespace shape_check_detail;
  if (shape.topology.fatal) return "the mesh cannot be used: " + describe(shape.topology);
  if (!shape.lattice) return "";
  const Lattice& lattice = *shape.lattice;
  if (lattice.cells.empty()) return "the lattice has no cell";
  std::string fault = lines_fault(lattice);
  if (fault.empty()) fault = grid_fault(lattice, lattice.cells, 1, "cell");
  if (fault.empty()) fault = grid_fault(lattice, lattice.nodes, 0, "node");
  if (fault.empty()) fault = cell_nodes_fault(lattice);
  if (fault.empty()) fault = homes_fault(shape.mesh, lattice, shape.embedding);
  if (fault.empty()) fault = labels_fault(shape.mesh, lattice, shape.embedding);
  return fault;
}

}  // namespace contactcheck
