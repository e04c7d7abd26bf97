#include "tests/bench/bench_bodies.h"

#include "core/types/check.h"
#include "reference/mesh/datasets.h"
#include "reference/mesh/tessellation.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck::bench {
namespace {

constexpr Resolution kLattice{6, 6, 6};

// `triangles` 0: all of them. `levels`: of the sphere that stands in.
BenchBody bunny_or_sphere(std::size_t triangles, int levels) {
  TriangleMesh mesh;
  std::string name = "bunny00";
  try {
    mesh = mesh::load_dataset("bunny00").mesh;
    if (triangles > 0) mesh = mesh::simplify(mesh, triangles);
  } catch (const InputError&) {
    name = "sphere";
    mesh = test::sphere_mesh(Vec3::Zero(), 1.0, levels);
  }
  name += "/" + std::to_string(mesh.vertices.size());
  return {name, make_shape(std::move(mesh), kLattice)};
}

}  // namespace

const BenchBody& small_body() {
  static const BenchBody body = bunny_or_sphere(5914, 5);
  return body;
}

const BenchBody& large_body() {
  static const BenchBody body = bunny_or_sphere(0, 7);
  return body;
}

std::vector<Vec3> shaken_nodes(const BodyShape& shape, double amount, const Vec3& offset) {
  test::TriangleSource random(7);
  const double radius = amount * bounding_box(shape.mesh.vertices).extent().maxCoeff();
  std::vector<Vec3> nodes = test::rest_nodes_at(shape, offset);
  for (Vec3& node : nodes) node = random.point(node, radius);
  return nodes;
}

}  // namespace contactcheck::bench
