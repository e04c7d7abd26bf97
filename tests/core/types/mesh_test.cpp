#include "core/types/mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/hash.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

TEST(Fnv1a, GivesThePublishedValues) {
  // Fowler, Noll, Vo: test vectors of 64-bit FNV-1a.
  EXPECT_EQ(Fnv1a{}.digest(), 0xcbf29ce484222325ull);
  Fnv1a a;
  a.bytes("a", 1);
  EXPECT_EQ(a.digest(), 0xaf63dc4c8601ec8cull);
  Fnv1a foobar;
  foobar.bytes("foo", 3);
  foobar.bytes("bar", 3);
  EXPECT_EQ(foobar.digest(), 0x85944171f73967e8ull);
}

TEST(ContentHash, SameMeshSameHash) {
  EXPECT_EQ(content_hash(test::unit_box_mesh(2)), content_hash(test::unit_box_mesh(2)));
}

TEST(ContentHash, SeesOneUlpOneIndexAndOneVertexMore) {
  const TriangleMesh mesh = test::unit_box_mesh(2);
  TriangleMesh ulp = mesh, turned = mesh, more = mesh;
  ulp.vertices[3].y() = std::nextafter(ulp.vertices[3].y(), 2.0);
  std::swap(turned.triangles[5][0], turned.triangles[5][1]);
  more.vertices.push_back(Vec3::Zero());
  for (const TriangleMesh& other : {ulp, turned, more})
    EXPECT_NE(content_hash(other), content_hash(mesh));
}

TEST(BoundingBox, HoldsExactlyTheExtremes) {
  const Aabb box = bounding_box(std::vector<Vec3>{{1, 5, -2}, {-3, 4, 8}, {0, 6, 0}});
  EXPECT_EQ(box.lo, Vec3(-3, 4, -2));
  EXPECT_EQ(box.hi, Vec3(1, 6, 8));
  EXPECT_TRUE(bounding_box(std::vector<Vec3>()).empty());
}

}  // namespace
}  // namespace contactcheck
