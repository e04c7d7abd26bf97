#include "reference/mesh/tessellation.h"

#include <gtest/gtest.h>

#include "core/types/mesh_topology.h"
#include "reference/mesh/shapes.h"

namespace contactcheck::mesh {
namespace {

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 *
           (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  return sum;
}

TEST(Subdivide, QuadruplesTheTrianglesOnTheSameSurface) {
  const TriangleMesh torus = make_torus(0.4, 12);
  const TriangleMesh finer = subdivide(torus, 2);
  EXPECT_EQ(finer.triangles.size(), 16 * torus.triangles.size());
  EXPECT_NEAR(area(finer), area(torus), 1e-12);
  EXPECT_TRUE(std::equal(torus.vertices.begin(), torus.vertices.end(), finer.vertices.begin()));
}

TEST(Subdivide, SharesMidpointsAndKeepsOrientation) {
  const TriangleMesh box = make_box(Vec3(1, 2, 3), 1);
  const TriangleMesh finer = subdivide(box, 1);
  // Euler: 18 edges, each with one midpoint.
  EXPECT_EQ(finer.vertices.size(), box.vertices.size() + 18);
  EXPECT_TRUE(analyse_topology(finer).solid);
  for (std::size_t t = 0; t < finer.triangles.size(); ++t) {
    const auto normal = [](const TriangleMesh& mesh, std::size_t i) {
      const auto& [a, b, c] = mesh.triangles[i];
      return Vec3((mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]));
    };
    EXPECT_GT(normal(finer, t).dot(normal(box, t / 4)), 0.0) << t;
  }
}

TEST(Subdivide, ZeroTimesIsTheSameMesh) {
  const TriangleMesh sphere = make_sphere(2);
  EXPECT_EQ(content_hash(subdivide(sphere, 0)), content_hash(sphere));
}

}  // namespace
}  // namespace contactcheck::mesh
