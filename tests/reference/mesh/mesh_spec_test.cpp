#include "reference/mesh/mesh_spec.h"

#include <gtest/gtest.h>

namespace contactcheck::mesh {
namespace {

TriangleMesh mesh_of(const std::string& spec) {
  const std::string document = "spec";
  const text::JsonValue value = text::parse_json(spec, document);
  const text::JsonField field(value, document);
  return build_mesh(parse_mesh_spec(field, ""), field).mesh;
}

TEST(MeshSpec, IsScaledToItsSizeAndThenMovedToItsCentre) {
  const Aabb box = bounding_box(
      mesh_of(R"({"shape": "box", "sides": [1, 2, 4], "size": 2, "center": [5, -1, 0.25]})")
          .vertices);
  EXPECT_EQ(box.lo, Vec3(4.75, -1.5, -0.75));
  EXPECT_EQ(box.hi, Vec3(5.25, -0.5, 1.25));
}

TEST(MeshSpec, WithoutCentreStaysWhereItsVerticesAre) {
  const Aabb box = bounding_box(mesh_of(R"({"shape": "box", "scale": 3})").vertices);
  EXPECT_EQ(box.lo, Vec3(-1.5, -1.5, -1.5));
  EXPECT_EQ(box.hi, Vec3(1.5, 1.5, 1.5));
}

// The centre is that of the box around the vertices, not their mean.
TEST(MeshSpec, OfAnUnevenMeshIsCentredByItsBox) {
  const Aabb box = bounding_box(
      mesh_of(R"({"shape": "letter", "letter": "L", "divisions": 2, "center": [0, 8, 0]})")
          .vertices);
  EXPECT_LT((box.center() - Vec3(0, 8, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace contactcheck::mesh
