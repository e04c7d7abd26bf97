// A body that can be given any deformed vertices, bit for bit, and still has a lattice: at rest its
// vertices are lattice nodes, and the canonical mapping reproduces nodes exactly (mapping.h).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck {

struct NodeShape {
  std::shared_ptr<const BodyShape> shape;
  /// Per lattice node the given number of its vertex; nodes without a vertex follow the last one.
  std::vector<std::uint32_t> vertex_of_node;

  /// Node positions that map the shape exactly to `vertices`. @pre one position per given vertex,
  /// also for those that no triangle uses: they are nodes, but not vertices of the shape
  std::vector<Vec3> nodes_for(std::span<const Vec3> vertices) const;
};

/// Vertices fill a cubic grid of unit cells row by row, the last one in the far corner.
/// @throws InputError when the triangles have a fatal defect
NodeShape make_node_shape(std::size_t vertices, std::vector<Triangle> triangles);

}  // namespace contactcheck
