#include "tests/conformance/meshes.h"

#include <utility>

namespace contactcheck::test {
namespace {

std::uint32_t add_vertex(TriangleMesh& mesh, const Vec3& at) {
  mesh.vertices.push_back(at);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::uint32_t first = add_vertex(mesh, a);
  add_vertex(mesh, b);
  add_vertex(mesh, c);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void append(TriangleMesh& mesh, const TriangleMesh& part, double factor, const Vec3& offset) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& v : part.vertices) mesh.vertices.push_back(factor * v + offset);
  for (const Triangle& t : part.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

TriangleMesh octahedron_mesh() { return sphere_mesh(Vec3::Zero(), kHalfSide, 0); }

TriangleMesh tetrahedron_mesh() {
  return {{Vec3(-1, -1, -1), Vec3(1, 1, -1), Vec3(1, -1, 1), Vec3(-1, 1, 1)},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

TriangleMesh cube_mesh(int n) {
  return box_mesh(Vec3::Constant(-kHalfSide), Vec3::Constant(kHalfSide), n);
}

TriangleMesh mesh_with_degenerate_triangles() {
  TriangleMesh mesh = octahedron_mesh();
  add_triangle(mesh, Vec3(0.5, 0.5, 0.5), Vec3(1, 0.5, 0.5), Vec3(0.75, 0.5, 0.5));
  const Vec3 point(0.875, 0.75, 0.75);
  add_triangle(mesh, point, point, point);
  mesh.triangles.push_back({0, 2, 0});
  return mesh;
}

TriangleMesh mesh_with_isolated_vertex() {
  TriangleMesh mesh = octahedron_mesh();
  add_vertex(mesh, Vec3::Ones());
  return mesh;
}

TriangleMesh open_mesh() {
  const TriangleMesh cube = cube_mesh(2);
  TriangleMesh mesh;
  mesh.vertices = cube.vertices;
  for (const Triangle& t : cube.triangles) {
    bool lid = true;
    for (std::uint32_t v : t) lid = lid && cube.vertices[v].x() == kHalfSide;
    if (!lid) mesh.triangles.push_back(t);
  }
  add_triangle(mesh, Vec3(1, 1, -1), Vec3(1, 1, 0), Vec3(1, 1, 1));
  return mesh;
}

TriangleMesh mesh_of_two_components() {
  TriangleMesh mesh;
  for (double side : {-0.5, 0.5}) append(mesh, octahedron_mesh(), 0.5, Vec3::Constant(side));
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3& v : mesh.vertices) v *= factor;
  return mesh;
}

Body exact_body(const std::string& name, TriangleMesh mesh) {
  return make_body(name, std::move(mesh), {4, 4, 4}, 0.5);
}

}  // namespace contactcheck::test
