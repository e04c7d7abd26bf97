// A body: a shape, shared by all its instances, and a name.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/deform/embedding.h"
#include "core/deform/lattice.h"
#include "core/types/frame.h"
#include "core/types/given_vertices.h"
#include "core/types/mesh.h"
#include "core/types/mesh_topology.h"

namespace contactcheck {

struct BodyShape {
  TriangleMesh mesh;               ///< at rest; a triangle uses each vertex
  GivenVertices given;             ///< which vertices those are of the mesh as it was given
  MeshTopology topology;           ///< of linked()
  std::optional<Lattice> lattice;  ///< none: nodes are vertices
  Embedding embedding;             ///< empty without a lattice
  /// Of a mesh that is welded: its triangles, each vertex replaced by the first one at its position
  /// at rest; else empty. Decides which triangles are neighbours, and nothing else.
  std::vector<Triangle> welded;

  /// The triangles by which two of them share vertices.
  const std::vector<Triangle>& linked() const { return welded.empty() ? mesh.triangles : welded; }
  /// Does the triangle use the vertex, or one that is welded to it?
  bool uses(std::uint32_t triangle, std::uint32_t vertex) const;
  std::size_t node_count() const { return lattice ? lattice->nodes.size() : mesh.vertices.size(); }
  std::size_t given_vertex_count() const { return mesh.vertices.size() + given.dropped; }
};

struct Body {
  std::string name;
  std::shared_ptr<const BodyShape> shape;
};

/// Drops the vertices that no triangle uses from mesh, topology, home cells and local coordinates.
/// @pre all of them are kept, none is welded
void drop_unused_vertices(BodyShape& shape);

// Shapes are made without vertices that no triangle uses: frames have no positions of these, and
// answers name the vertices of shape->mesh. BodyShape::given leads from one to the other.

/// Builds a shape in a lattice of the given resolution.
/// @throws InputError when the mesh has a fatal defect or is too large (mesh_size_fault)
std::shared_ptr<const BodyShape> make_shape(TriangleMesh mesh, const Resolution& resolution,
                                            double padding = 0.02);
/// Builds a shape in a lattice on given grid lines (make_lattice_on_lines).
/// @throws InputError when the mesh has a fatal defect or is too large (mesh_size_fault)
std::shared_ptr<const BodyShape> make_shape_on_lines(TriangleMesh mesh,
                                                     std::array<std::vector<double>, 3> lines);
/// Builds a shape without a lattice (static or recorded). @throws InputError likewise
std::shared_ptr<const BodyShape> make_bare_shape(TriangleMesh mesh);

/// The same shape, its mesh welded: vertices with equal coordinates at rest (-0 = 0) are one.
std::shared_ptr<const BodyShape> welded(const BodyShape& shape);
/// The given numbers of two vertices that are welded and not at one place; none where all keep
/// together.
std::optional<std::array<std::uint32_t, 2>> torn_weld(const BodyShape& shape,
                                                      std::span<const Vec3> vertices);

/// Deformed vertices of a body: canonical mapping, or a copy of the nodes without a lattice.
void map_body(const BodyShape& shape, std::span<const Vec3> nodes, std::span<Vec3> out);

}  // namespace contactcheck
