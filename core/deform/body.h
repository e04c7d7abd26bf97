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
  GivenVertices given;             ///< maps vertices to those of the mesh as given
  MeshTopology topology;           ///< of linked()
  std::optional<Lattice> lattice;  ///< none: nodes are vertices
  Embedding embedding;             ///< empty without a lattice
  /// The triangles of a welded mesh, each vertex replaced by the first one at its position at rest;
  /// empty if not welded. Only neighbours, uses() and `topology` depend on it.
  std::vector<Triangle> welded;

  /// The triangles whose indices say which triangles share vertices: the welded ones, if any.
  const std::vector<Triangle>& linked() const { return welded.empty() ? mesh.triangles : welded; }
  /// True if the triangle uses the vertex, or one that is welded to it.
  bool uses(std::uint32_t triangle, std::uint32_t vertex) const;
  std::size_t node_count() const { return lattice ? lattice->nodes.size() : mesh.vertices.size(); }
  std::size_t given_vertex_count() const { return mesh.vertices.size() + given.dropped; }
};

struct Body {
  std::string name;
  std::shared_ptr<const BodyShape> shape;
};

/// Drops the vertices that no triangle uses from mesh, topology, home cells and local coordinates;
/// the caller then calls sort_by_cell(). @pre none was dropped before, and the mesh is not welded
void drop_unused_vertices(BodyShape& shape);

// Shapes are made without vertices that no triangle uses: frames have no positions for these, and
// answers name the vertices of shape->mesh. BodyShape::given maps them to those of the given mesh.

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

/// A copy of the shape with its mesh welded: vertices with equal rest coordinates (-0 = 0) are one.
std::shared_ptr<const BodyShape> welded(const BodyShape& shape);
/// The given numbers of the first two welded vertices whose positions differ; none if there are no
/// such two.
std::optional<std::array<std::uint32_t, 2>> torn_weld(const BodyShape& shape,
                                                      std::span<const Vec3> vertices);

/// Computes deformed vertices: canonical mapping, or without a lattice a copy of the nodes.
void map_body(const BodyShape& shape, std::span<const Vec3> nodes, std::span<Vec3> out);

}  // namespace contactcheck
