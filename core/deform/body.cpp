#include "core/deform/body.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/deform/mapping.h"
#include "core/types/check.h"
#include "core/types/vertex_places.h"

namespace contactcheck {
namespace {

std::shared_ptr<BodyShape> checked_shape(TriangleMesh mesh) {
  const std::string too_large = mesh_size_fault(mesh.vertices.size(), mesh.triangles.size());
  if (!too_large.empty()) throw InputError("the mesh cannot be used: it " + too_large);
  auto shape = std::make_shared<BodyShape>();
  shape->mesh = std::move(mesh);
  shape->topology = analyse_topology(shape->mesh);
  if (shape->topology.fatal) {
    throw InputError("the mesh cannot be used: " + describe(shape->topology));
  }
  drop_unused_vertices(*shape);
  return shape;
}

}  // namespace

void drop_unused_vertices(BodyShape& shape) {
  shape.given = drop_unused_vertices(shape.mesh);
  if (shape.given.dropped == 0) return;
  shape.topology = analyse_topology(shape.mesh);
  if (!shape.lattice) return;
  Embedding& embedding = shape.embedding;
  embedding.home_cell = shape.given.kept(std::move(embedding.home_cell));
  embedding.local = shape.given.kept(std::move(embedding.local));
}

std::shared_ptr<const BodyShape> make_shape(TriangleMesh mesh, const Resolution& resolution,
                                            double padding) {
  std::shared_ptr<BodyShape> shape = checked_shape(std::move(mesh));
  shape->lattice = make_lattice(shape->mesh, resolution, padding);
  shape->embedding = embed(shape->mesh, *shape->lattice);
  return shape;
}

std::shared_ptr<const BodyShape> make_shape_on_lines(TriangleMesh mesh,
                                                     std::array<std::vector<double>, 3> lines) {
  std::shared_ptr<BodyShape> shape = checked_shape(std::move(mesh));
  shape->lattice = make_lattice_on_lines(shape->mesh, std::move(lines));
  shape->embedding = embed(shape->mesh, *shape->lattice);
  return shape;
}

std::shared_ptr<const BodyShape> make_bare_shape(TriangleMesh mesh) {
  return checked_shape(std::move(mesh));
}

bool BodyShape::uses(std::uint32_t triangle, std::uint32_t vertex) const {
  return std::ranges::any_of(mesh.triangles[triangle], [&](std::uint32_t v) {
    return v == vertex || (!welded.empty() && mesh.vertices[v] == mesh.vertices[vertex]);
  });
}

std::shared_ptr<const BodyShape> welded(const BodyShape& shape) {
  auto out = std::make_shared<BodyShape>(shape);
  const std::vector<std::uint32_t> first = first_at_place(shape.mesh.vertices);
  out->welded = shape.mesh.triangles;
  for (Triangle& triangle : out->welded)
    for (std::uint32_t& vertex : triangle) vertex = first[vertex];
  // Duplicates and open edges are those of the triangles as they are linked now.
  out->topology = analyse_topology({shape.mesh.vertices, out->welded});
  return out;
}

std::optional<std::array<std::uint32_t, 2>> torn_weld(const BodyShape& shape,
                                                      std::span<const Vec3> vertices) {
  for (std::size_t t = 0; t < shape.welded.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t own = shape.mesh.triangles[t][c], first = shape.welded[t][c];
      if (vertices[own] != vertices[first])
        return std::array{shape.given.number_of(first), shape.given.number_of(own)};
    }
  return std::nullopt;
}

void map_body(const BodyShape& shape, std::span<const Vec3> nodes, std::span<Vec3> out) {
  CONTACTCHECK_INVARIANT(nodes.size() == shape.node_count(), "one position per node");
  CONTACTCHECK_INVARIANT(out.size() == shape.mesh.vertices.size(), "one place per vertex");
  if (shape.lattice) {
    map_vertices(*shape.lattice, shape.embedding, nodes, out);
  } else {
    std::copy(nodes.begin(), nodes.end(), out.begin());
  }
}

}  // namespace contactcheck
