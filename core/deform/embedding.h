// How a mesh sits in its lattice: a home cell and local coordinates per vertex, labels per
// triangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/deform/lattice.h"
#include "core/types/mesh.h"

namespace contactcheck {

/// Elements that a vector load may read beyond the last one; at least the lanes of any vector.
inline constexpr std::size_t kEmbeddingPadding = 8;

struct Embedding {
  std::vector<std::uint32_t> home_cell;  ///< per vertex: index of a kept cell
  std::vector<Vec3> local;               ///< per vertex: (s, t, u) in [0, 1] in its home cell

  /// The label of a triangle: every kept cell whose closed box it meets at rest (exact), ascending.
  /// Level `cell` is judged by labels, not by containment (fixtures/README.md, "Glossary").
  std::vector<std::uint32_t> label_begin;  ///< size: triangles + 1
  std::vector<std::uint32_t> label_cells;

  /// Vertices sorted by home cell, in blocks, for the batch mapping (see mapping.h).
  std::vector<std::uint32_t> cell_order;  ///< vertex indices
  std::vector<std::uint32_t> cell_begin;  ///< size: kept cells + 1; range in cell_order
  /// Local coordinates in cell_order, per axis, followed by kEmbeddingPadding zeros.
  std::array<std::vector<double>, 3> sorted_local;

  std::span<const std::uint32_t> cells_of_triangle(std::uint32_t triangle) const {
    return std::span(label_cells)
        .subspan(label_begin[triangle], label_begin[triangle + 1] - label_begin[triangle]);
  }
};

/// Rebuilds the cell-sorted arrays from home cells and local coordinates.
void sort_by_cell(std::size_t cells, Embedding& out);

/// Embedding::sorted_local in single precision: rounded once, with the same padding.
using SingleLocal = std::array<std::vector<float>, 3>;
SingleLocal single_local(const Embedding& embedding);

/// @pre the lattice was made for this mesh by make_lattice, and a triangle uses each vertex
/// @throws InputError when the labels together have more cells than 32-bit indices can number
Embedding embed(const TriangleMesh& mesh, const Lattice& lattice);

}  // namespace contactcheck
