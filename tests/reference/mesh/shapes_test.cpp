#include "reference/mesh/shapes.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "core/types/mesh_topology.h"

namespace contactcheck::mesh {
namespace {

// Positive when the triangles run counter-clockwise seen from outside.
double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  }
  return sum;
}

// V - E + F = 2 - 2 * handles for one closed component.
int handles(const TriangleMesh& mesh) {
  const auto v = static_cast<int>(mesh.vertices.size()),
             f = static_cast<int>(mesh.triangles.size());
  return (2 - (v - 3 * f / 2 + f)) / 2;
}

TEST(Shapes, BoxHasItsSidesAndCounts) {
  const TriangleMesh box = make_box(Vec3(1, 2, 3), 4);
  EXPECT_EQ(box.triangles.size(), 12u * 16u);
  EXPECT_TRUE(analyse_topology(box).defects.empty());
  EXPECT_EQ(bounding_box(box.vertices).lo, Vec3(-0.5, -1, -1.5));
  EXPECT_EQ(bounding_box(box.vertices).hi, Vec3(0.5, 1, 1.5));
  EXPECT_NEAR(volume(box), 6.0, 1e-12);
}

TEST(Shapes, SphereLiesOnTheSphereAtEveryLevel) {
  for (std::size_t level = 0; level <= 4; ++level) {
    const TriangleMesh sphere = make_sphere(level);
    EXPECT_EQ(sphere.triangles.size(), 20u << (2 * level));
    EXPECT_TRUE(analyse_topology(sphere).defects.empty());
    EXPECT_GT(volume(sphere), 0.3);
    EXPECT_EQ(handles(sphere), 0);
    for (const Vec3& v : sphere.vertices) EXPECT_NEAR(v.norm(), 0.5, 1e-15);
  }
}

TEST(Shapes, TorusIsASolidWithOneHandle) {
  const TriangleMesh torus = make_torus(0.4, 16);
  EXPECT_EQ(torus.triangles.size(), 1024u);
  EXPECT_TRUE(analyse_topology(torus).defects.empty());
  EXPECT_EQ(handles(torus), 1);
  EXPECT_EQ(bounding_box(torus.vertices).hi.x(), 0.5);
  // 2 pi^2 R r^2, less what the facets cut off.
  const double exact = 2 * M_PI * M_PI * (0.5 / 1.4) * std::pow(0.4 * 0.5 / 1.4, 2);
  EXPECT_GT(volume(torus), 0.95 * exact);
  EXPECT_LT(volume(torus), exact);
}

TEST(Shapes, SheetIsFlatAndOpen) {
  const TriangleMesh sheet = make_sheet(2.0, 3);
  EXPECT_EQ(sheet.triangles.size(), 18u);
  EXPECT_EQ(bounding_box(sheet.vertices).lo, Vec3(-0.5, 0, -1));
  EXPECT_EQ(bounding_box(sheet.vertices).hi, Vec3(0.5, 0, 1));
  const MeshTopology topology = analyse_topology(sheet);
  EXPECT_FALSE(topology.solid);
  EXPECT_EQ(topology.defects.size(), topology.count(MeshDefectKind::kBoundaryEdge));
  for (const Triangle& t : sheet.triangles) {
    const Vec3 &a = sheet.vertices[t[0]], &b = sheet.vertices[t[1]], &c = sheet.vertices[t[2]];
    EXPECT_GT((b - a).cross(c - a).y(), 0.0);
  }
}

TEST(Circle, AgreesWithLibmAndIsExactAtTheQuarters) {
  for (std::size_t n = 1; n <= 200; ++n) {
    for (std::size_t k = 0; k < n; ++k) {
      const CirclePoint p = circle_point(k, n);
      const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(n);
      EXPECT_NEAR(p.cosine, std::cos(angle), 2e-15) << k << "/" << n;
      EXPECT_NEAR(p.sine, std::sin(angle), 2e-15) << k << "/" << n;
    }
  }
  EXPECT_EQ(circle_point(1, 4).cosine, 0.0);
  EXPECT_EQ(circle_point(1, 4).sine, 1.0);
  EXPECT_EQ(circle_point(2, 4).cosine, -1.0);
  EXPECT_EQ(circle_point(3, 4).sine, -1.0);
}

TEST(Circle, MirroredPointsHaveMirroredBits) {
  for (std::size_t k = 0; k <= 24; ++k) {
    EXPECT_EQ(circle_point(k, 48).cosine, -circle_point(24 - k, 48).cosine);
    EXPECT_EQ(circle_point(k, 48).sine, circle_point(24 - k, 48).sine);
    EXPECT_EQ(circle_point(k, 48).cosine, circle_point((48 - k) % 48, 48).cosine);
    EXPECT_EQ(circle_point(k, 48).sine, circle_point((60 - k) % 48, 48).cosine);
  }
}

class Letter : public ::testing::TestWithParam<char> {};

int holes_of(char letter) {
  return letter == 'B' ? 2 : std::string("ADOPR").find(letter) != std::string::npos ? 1 : 0;
}

TEST_P(Letter, IsOneSolidWithItsHoles) {
  for (std::size_t divisions = 1; divisions <= 4; ++divisions) {
    for (const double depth : {0.05, 0.2, 0.5}) {
      const TriangleMesh mesh = make_letter(GetParam(), depth, divisions);
      const MeshTopology topology = analyse_topology(mesh);
      EXPECT_TRUE(topology.defects.empty()) << describe(topology);
      EXPECT_EQ(handles(mesh), holes_of(GetParam()));
      EXPECT_GT(volume(mesh), 0.0);
      const Vec3 extent = bounding_box(mesh.vertices).extent();
      EXPECT_NEAR(extent.y(), 1.0, 0.011);
      EXPECT_NEAR(extent.z(), depth, 1e-15);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Alphabet, Letter,
                         ::testing::ValuesIn(known_letters().begin(), known_letters().end()),
                         [](const auto& test) { return std::string(1, test.param); });

TEST(Letters, AreAllDifferentFromOneAnother) {
  std::set<std::uint64_t> hashes;
  for (const char c : known_letters()) hashes.insert(content_hash(make_letter(c, 0.2, 2)));
  EXPECT_EQ(hashes.size(), known_letters().size());
}

TEST(Letters, HaveThePapersSizeWithFourDivisions) {
  for (const char c : std::string("ABDOPR")) {
    const std::size_t triangles = make_letter(c, 0.2, 4).triangles.size();
    EXPECT_GE(triangles, 2402u) << c;
    EXPECT_LE(triangles, 3600u) << c;
  }
}

}  // namespace
}  // namespace contactcheck::mesh
