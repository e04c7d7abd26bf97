#include "reference/oracle/vertex_queries.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "reference/oracle/closed_chain.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

using oracle::SurfaceTree;

class Solid {
 public:
  explicit Solid(TriangleMesh mesh) : mesh_(std::move(mesh)), tree_(mesh_) {
    tree_.refit(mesh_.vertices);
  }
  Solid(const Solid&) = delete;
  Solid& operator=(const Solid&) = delete;
  std::optional<int> winding(const Vec3& p) const { return oracle::winding_number(tree_, p); }
  bool holds(const Vec3& p) const { return oracle::strictly_inside(tree_, p); }
  const TriangleMesh& mesh() const { return mesh_; }
  const SurfaceTree& tree() const { return tree_; }

 private:
  TriangleMesh mesh_;
  SurfaceTree tree_;
};

TEST(Winding, BoxOnAGridWithAllRaysDegenerate) {
  const Solid box(unit_box_mesh(4));
  for (int i = -2; i <= 10; ++i)
    for (int j = -2; j <= 10; ++j)
      for (int k = -2; k <= 10; ++k) {
        // Eighths: a quarter of them runs along the edges and corners of the mesh.
        const Vec3 p(i / 8.0, j / 8.0, k / 8.0);
        const bool closed = p.minCoeff() >= 0 && p.maxCoeff() <= 1;
        const bool open = p.minCoeff() > 0 && p.maxCoeff() < 1;
        ASSERT_EQ(box.holds(p), open) << p.transpose();
        const std::optional<int> expected =
            closed && !open ? std::nullopt : std::optional<int>(open ? 1 : 0);
        ASSERT_EQ(box.winding(p), expected) << p.transpose();
      }
}

TEST(Winding, OneUlpDecides) {
  const Solid box(unit_box_mesh(3));
  EXPECT_TRUE(box.holds({0x1p-1074, 0.5, 0.5}));
  EXPECT_TRUE(box.holds({0x1p-1074, 0x1p-1074, 0x1p-1074}));
  EXPECT_FALSE(box.holds({0, 0.5, 0.5}));
  EXPECT_FALSE(box.holds({-0x1p-1074, 0.5, 0.5}));
  EXPECT_TRUE(box.holds({std::nextafter(1.0, 0.0), 0.5, 0.5}));
  EXPECT_FALSE(box.holds({1, 0.5, 0.5}));
  EXPECT_FALSE(box.holds({std::nextafter(1.0, 2.0), 0.5, 0.5}));
}

TEST(Winding, VerticesEdgesAndFacesAreNotInside) {
  const Solid torus(torus_mesh(1.0, 0.25, 16, 8));
  for (const Vec3& v : torus.mesh().vertices) EXPECT_EQ(torus.winding(v), std::nullopt);
  const Solid grid(box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 2));
  for (const Triangle& t : grid.mesh().triangles) {
    const Vec3 &a = grid.mesh().vertices[t[0]], &b = grid.mesh().vertices[t[1]];
    EXPECT_EQ(grid.winding(0.5 * a + 0.5 * b), std::nullopt);
    const Vec3& c = grid.mesh().vertices[t[2]];
    EXPECT_EQ(grid.winding(0.5 * a + 0.25 * b + 0.25 * c), std::nullopt);
  }
}

// Between the tube that fits inside every facet and the one that holds all vertices nothing is
// said.
TEST(Winding, TorusInsideHoleAndOutside) {
  const Solid torus(torus_mesh(1.0, 0.4, 40, 24));
  TriangleSource source(301);
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = source.point(Vec3::Zero(), 1.5);
    const double off = std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z());
    if (off < 0.36) {
      ASSERT_EQ(torus.winding(p), 1) << p.transpose();
      ++inside;
    } else if (off > 0.4001) {
      ASSERT_EQ(torus.winding(p), 0) << p.transpose();
    }
  }
  EXPECT_GT(inside, 300);
  EXPECT_FALSE(torus.holds(Vec3::Zero()));
}

TEST(Winding, SphereAtSubnormalScale) {
  for (double scale : {1e-160, 1e-300, 1e-320}) {
    TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 3);
    mesh.vertices = scaled(mesh.vertices, scale);
    const Solid sphere(mesh);
    EXPECT_TRUE(sphere.holds(Vec3::Zero())) << scale;
    EXPECT_TRUE(sphere.holds(Vec3(0.9, 0, 0) * scale)) << scale;
    EXPECT_FALSE(sphere.holds(Vec3(1.1, 0, 0) * scale)) << scale;
    EXPECT_FALSE(sphere.holds(mesh.vertices[5])) << scale;
  }
}

TEST(Winding, ShellBetweenNestedBoxes) {
  const Solid shell(joined(box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 3),
                           reversed(box_mesh(Vec3(1, 1, 1), Vec3(3, 3, 3), 2))));
  EXPECT_EQ(shell.winding({2, 2, 2}), 0);
  EXPECT_EQ(shell.winding({0.5, 2, 2}), 1);
  EXPECT_EQ(shell.winding({3.5, 3.5, 3.5}), 1);
  EXPECT_EQ(shell.winding({1, 2, 2}), std::nullopt);
}

TEST(Winding, OverlapCountsTwiceAndInsideOutCountsNegative) {
  const TriangleMesh a = box_mesh(Vec3(0, 0, 0), Vec3(2, 2, 2), 2);
  const TriangleMesh b = box_mesh(Vec3(1, 1, 1), Vec3(3, 3, 3), 2);
  const Solid twice(joined(a, b));
  EXPECT_EQ(twice.winding({0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(twice.winding({1.5, 1.5, 1.5}), 2);
  EXPECT_EQ(twice.winding({1.5, 1.5, 1}), std::nullopt);  // on the surface, within the other
  EXPECT_EQ(twice.winding({2.5, 2.5, 2.5}), 1);
  EXPECT_EQ(twice.winding({0.5, 2.5, 1.5}), 0);
  const Solid inside_out(reversed(a));
  EXPECT_EQ(inside_out.winding({0.5, 1, 1}), -1);
  EXPECT_TRUE(inside_out.holds({0.5, 1, 1}));
}

TEST(Winding, FlattenedBodyHasNoInside) {
  TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 2);
  for (Vec3& v : mesh.vertices) v.z() = 0;
  const Solid flat(mesh);
  EXPECT_FALSE(flat.holds({0.1, 0.2, 0}));
  EXPECT_FALSE(flat.holds({0.1, 0.2, 0.1}));
  TriangleMesh needle = sphere_mesh(Vec3::Zero(), 1.0, 2);
  for (Vec3& v : needle.vertices) v.y() = v.z() = 0;
  EXPECT_FALSE(Solid(needle).holds({0.1, 0, 0}));
}

// Signed crossings of a segment to a far point in general position, in rational arithmetic.
std::optional<int> slow_winding(const SurfaceTree& tree, std::uint32_t count, const Vec3& p) {
  const Vec3 far(937.125, 1013.0625, 1171.03125);
  int winding = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const oracle::TriangleCorners t = tree.corners(i);
    if (oracle::rational::triangles_intersect(t, {p, p, p})) return std::nullopt;
    const int from = oracle::rational::orient3d(t[0], t[1], t[2], p);
    const int to = oracle::rational::orient3d(t[0], t[1], t[2], far);
    // A point in the triangle's plane, but not on it, is where the segment leaves that plane.
    if (from * to >= 0) continue;
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; ++k) {
      const int side = oracle::rational::orient3d(p, far, t[k], t[(k + 1) % 3]);
      positive += side > 0;
      negative += side < 0;
    }
    EXPECT_TRUE(positive + negative == 3 || positive * negative > 0) << "not in general position";
    if (positive == 3 || negative == 3) winding += to > from ? 1 : -1;
  }
  return winding;
}

// Two crumpled spheres, which intersect themselves and each other everywhere; small integers make
// degenerate rays common.
TEST(WindingAgainstRational, CrumpledSpheres) {
  TriangleSource source(302);
  int by_winding[7] = {}, on_surface = 0;
  for (int round = 0; round < 12; ++round) {
    const TriangleMesh ball = sphere_mesh(Vec3::Zero(), 1.0, 1);
    TriangleMesh mesh = round % 3 == 0 ? joined(ball, reversed(ball)) : joined(ball, ball);
    const bool grid = round % 2 == 0;
    for (Vec3& v : mesh.vertices)
      v = grid ? Vec3(source.grid_point(3) + 3 * Vec3(v)).array().round().matrix().eval()
               : source.point(v, 0.7);
    const Solid solid(mesh);
    for (int i = 0; i < 60; ++i) {
      const Vec3 p = grid ? Vec3(source.grid_point(4)) : source.point(Vec3::Zero(), 0.9);
      const auto expected =
          slow_winding(solid.tree(), static_cast<std::uint32_t>(mesh.triangles.size()), p);
      ASSERT_EQ(solid.winding(p), expected) << hex_points(mesh.vertices) << hex_points({&p, 1});
      if (!expected) ++on_surface;
      if (expected && std::abs(*expected) <= 3) ++by_winding[*expected + 3];
    }
  }
  EXPECT_GT(on_surface, 10);
  EXPECT_GT(by_winding[2] + by_winding[1], 3);   // negative
  EXPECT_GT(by_winding[3], 50);                  // outside
  EXPECT_GT(by_winding[4], 30);                  // once
  EXPECT_GT(by_winding[5] + by_winding[6], 10);  // more than once
}

// How often the surface wraps the point, by its solid angle: in doubles, far from deciding.
int rounded_solid_angle(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
               c = mesh.vertices[t[2]] - p;
    sum += 2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                 b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return static_cast<int>(std::lround(sum / (4 * std::acos(-1.0))));
}

// Any number of sheets on an edge, in both directions, one upon the other, with triangles of no
// area: rays along the grid meet them in corners and edges.
TEST(WindingAgainstRational, ClosedChainsThatAreNoManifolds) {
  TriangleSource source(303);
  int by_winding[9] = {}, on_surface = 0, shared = 0;
  for (int round = 0; round < 24; ++round) {
    const int count = 4 + round % 8;
    const TriangleMesh mesh = tetrahedra_on_a_grid(source, count, 1 + round % 2);
    const auto chain = oracle::surface_chain(mesh.triangles, mesh.vertices);
    shared += chain.component_vertex.size() < static_cast<std::size_t>(count);
    const Solid solid(mesh);
    for (int i = 0; i < 20; ++i) {
      // Halves run along the edges of the grid and of its diagonals.
      const Vec3 p = i % 4 == 0 ? source.point(Vec3::Zero(), 1.5) : source.grid_point(3) / 2;
      const auto expected =
          slow_winding(solid.tree(), static_cast<std::uint32_t>(mesh.triangles.size()), p);
      ASSERT_EQ(solid.winding(p), expected) << hex_points(mesh.vertices) << hex_points({&p, 1});
      if (!expected) {
        ++on_surface;
        continue;
      }
      ASSERT_EQ(rounded_solid_angle(mesh, p), *expected);
      if (std::abs(*expected) <= 4) ++by_winding[*expected + 4];
    }
  }
  EXPECT_GT(shared, 10);  // some hang together by an edge
  EXPECT_GT(on_surface, 50);
  EXPECT_GT(by_winding[2] + by_winding[3], 15);
  EXPECT_GT(by_winding[4], 200);
  EXPECT_GT(by_winding[5] + by_winding[6], 15);
}

TEST(Winding, SheetsThatShareAnEdgeAndRepeatedCorners) {
  TriangleMesh mesh =
      joined(box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), 1), box_mesh(Vec3(1, 1, 0), Vec3(2, 2, 1), 1));
  mesh.triangles.push_back({3, 3, 5});
  const TriangleMesh wall = triangle_mesh(Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1));
  const Solid solid(joined(joined(mesh, wall), reversed(wall)));
  EXPECT_EQ(solid.winding({0.5, 0.25, 0.5}), 1);
  EXPECT_EQ(solid.winding({0.25, 0.5, 0.5}), 1);
  EXPECT_EQ(solid.winding({0.5, 0.5, 0.25}), std::nullopt);  // on the wall
  EXPECT_EQ(solid.winding({1.5, 1.5, 0.5}), 1);
  EXPECT_EQ(solid.winding({1.5, 0.5, 0.5}), 0);
  EXPECT_EQ(solid.winding({-1, 1, 0.5}), 0);  // its ray runs through the shared edge
  EXPECT_EQ(solid.winding({1, 1, 0.5}), std::nullopt);
}

// An edge against two that run along it, and the triangle of no area between them.
TEST(Winding, SeamThatASliverFills) {
  const Solid solid({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                     {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 1, 4}}});
  EXPECT_EQ(solid.winding({0.25, 0.25, 0.25}), 1);
  EXPECT_EQ(solid.winding({-1, 0.25, 0.25}), 0);
  EXPECT_EQ(solid.winding({-1, 0, 0}), 0);  // its ray runs along the seam
  EXPECT_EQ(solid.winding({0.5, -1, 0}), 0);
  EXPECT_EQ(solid.winding({1, 0, 0}), std::nullopt);
}

}  // namespace
}  // namespace contactcheck::test
