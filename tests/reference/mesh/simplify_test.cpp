#include "reference/mesh/tessellation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/types/mesh_topology.h"
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

TEST(Simplify, NoVertexIsLeftWithoutATriangle) {
  const TriangleMesh less = simplify(make_sphere(3), 300);
  std::set<std::uint32_t> used;
  for (const Triangle& t : less.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), less.vertices.size());
}

}  // namespace
}  // namespace contactcheck::mesh
