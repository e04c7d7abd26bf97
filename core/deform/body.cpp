#include "core/deform/body.h"

#include <algorithm>

#include "core/deform/mapping.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

std::shared_ptr<BodyShape> checked_shape(TriangleMesh mesh) {
  auto shape = std::make_shared<BodyShape>();
  shape->mesh = std::move(mesh);
  shape->topology = analyse_topology(shape->mesh);
  if (shape->topology.fatal) {
    throw InputError("the mesh cannot be used: " + describe(shape->topology));
  }
  return shape;
}

}  // namespace

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
