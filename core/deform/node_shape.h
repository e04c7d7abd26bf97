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
  /// Per lattice node: the vertex that it is; a node that is no vertex follows the last vertex.
  std::vector<std::uint32_t> vertex_of_node;

  /// The nodes that put the vertices where they are wanted. @pre one position per vertex as given:
  /// one that no triangle uses is no vertex of the shape, but still a node
  std::vector<Vec3> nodes_for(std::span<const Vec3> vertices) const;
};

/// Vertices fill a cubic grid of unit cells row by row, the last one in the far corner.
/// @throws InputError when the triangles have a fatal defect
NodeShape make_node_shape(std::size_t vertices, std::vector<Triangle> triangles);

}  // namespace contactcheck
