#include "reference/mesh/tessellation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/types/mesh_topology.h"
#include "core/types/vertex_places.h"
#include "reference/mesh/shapes.h"

namespace contactcheck::mesh {
namespace {

std::set<std::array<double, 3>> places(const TriangleMesh& mesh) {
  std::set<std::array<double, 3>> out;
  for (const Vec3& v : mesh.vertices) out.insert({v.x(), v.y(), v.z()});
  return out;
}

TEST(Simplify, ReachesTheCountAndKeepsDoubles) {
  TriangleMesh sphere = make_sphere(4);
  // Coordinates that floats could neither tell apart nor give back.
  for (Vec3& v : sphere.vertices) v += Vec3(1e9, 1e9, 1e9);
  const TriangleMesh less = simplify(sphere, 1000);
  EXPECT_EQ(less.triangles.size(), 1000u);
  EXPECT_EQ(less.vertices.size(), 502u);
  EXPECT_TRUE(analyse_topology(less).solid);
  const auto before = places(sphere), after = places(less);
  EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
}

TEST(Simplify, GivesTheSameMeshEveryTime) {
  const TriangleMesh mesh = make_torus(0.4, 24);
  EXPECT_EQ(content_hash(simplify(mesh, 600)), content_hash(simplify(mesh, 600)));
}

TEST(Simplify, SmallMeshIsReturnedAsItIs) {
  const TriangleMesh box = make_box(Vec3(1, 1, 1), 2);
  EXPECT_EQ(content_hash(simplify(box, 48)), content_hash(box));
}

TEST(Simplify, LettersOfThePapersSizeStaySolid) {
  for (const char c : std::string("ABDOPR")) {
    const TriangleMesh letter = simplify(make_letter(c, 0.2, 4), 2402);
    EXPECT_EQ(letter.triangles.size(), 2402u) << c;
    EXPECT_TRUE(analyse_topology(letter).solid) << c;
  }
}

// A sphere as textured ones are: its columns begin and end on vertices of their own, and each has
// its own poles.
TriangleMesh textured_sphere(std::uint32_t columns, std::uint32_t rows) {
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r <= rows; ++r)
    for (std::uint32_t c = 0; c <= columns; ++c) {
      const CirclePoint along = circle_point(c % columns, columns), up = circle_point(r, 2 * rows);
      mesh.vertices.push_back(Vec3(up.sine * along.cosine, up.sine * along.sine, up.cosine) * 0.5);
    }
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
      if (r > 0) mesh.triangles.push_back({a, b, a + 1});
      if (r + 1 < rows) mesh.triangles.push_back({a + 1, b, b + 1});
    }
  return mesh;
}

// Each triangle with corners of its own.
TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) out.vertices.push_back(mesh.vertices[v]);
    const auto end = static_cast<std::uint32_t>(out.vertices.size());
    out.triangles.push_back({end - 3, end - 2, end - 1});
  }
  return out;
}

bool closed_when_joined(TriangleMesh mesh) {
  const std::vector<std::uint32_t> first = first_at_place(mesh.vertices);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = first[v];
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return analyse_topology(mesh).solid;
}

// Also where every part of the surface has a vertex of its own at its border.
TEST(Simplify, CopiesOfVerticesDoNotKeepTriangles) {
  for (const TriangleMesh& mesh :
       {textured_sphere(48, 24), soup(make_sphere(3)), soup(make_torus(0.4, 12))}) {
    const TriangleMesh less = simplify(mesh, 300);
    EXPECT_LE(less.triangles.size(), 300u) << mesh.triangles.size();
    EXPECT_GE(less.triangles.size(), 290u) << mesh.triangles.size();
    EXPECT_TRUE(closed_when_joined(less)) << mesh.triangles.size();
    const auto before = places(mesh), after = places(less);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
  }
}

TEST(Simplify, CopiesOfVerticesOfACubeDoNotKeepTriangles) {
  EXPECT_EQ(simplify(soup(make_box(Vec3(1, 1, 1), 4)), 12).triangles.size(), 12u);
}

// Nothing but a segment is left of such a triangle.
TEST(Simplify, SlitsOfCopiesDoNotHinder) {
  TriangleMesh mesh = textured_sphere(48, 24);
  mesh.vertices.push_back(mesh.vertices[100]);
  mesh.triangles.push_back({100, 101, static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
  const TriangleMesh less = simplify(mesh, 300);
  EXPECT_LE(less.triangles.size(), 300u);
  EXPECT_TRUE(closed_when_joined(less));
}

TEST(Simplify, NoVertexIsLeftWithoutATriangle) {
  const TriangleMesh less = simplify(make_sphere(3), 300);
  std::set<std::uint32_t> used;
  for (const Triangle& t : less.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), less.vertices.size());
}

}  // namespace
}  // namespace contactcheck::mesh
