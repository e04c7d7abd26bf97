#include "core/deform/mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <string>

#include "tests/core/deform/scoped_target.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"
#include "tests/support/wide.h"

namespace contactcheck {
namespace {

using test::compiled_targets;
using test::ScopedTarget;
using test::Wide;

bool same_bits(const Vec3& a, const Vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::vector<Vec3> random_nodes(test::TriangleSource& random, std::size_t count, const Vec3& center,
                               double radius) {
  std::vector<Vec3> nodes(count);
  for (Vec3& n : nodes) n = random.point(center, radius);
  return nodes;
}

// How many of the vertices differ in any bit from map_point.
std::size_t different_vertices(const BodyShape& shape, const std::vector<Vec3>& nodes) {
  std::vector<Vec3> mapped(shape.mesh.vertices.size(), Vec3::Constant(-7.0));
  map_vertices(*shape.lattice, shape.embedding, nodes, mapped);
  std::size_t different = 0;
  for (std::size_t v = 0; v < mapped.size(); ++v) {
    const Corners corners = corners_of(*shape.lattice, shape.embedding.home_cell[v], nodes);
    different += !same_bits(mapped[v], map_point(corners, shape.embedding.local[v]));
  }
  return different;
}

TEST(Mapping, BatchGivesTheBitsOfThePointVersion) {
  const auto shape = make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 3), {5, 4, 3});
  std::set<std::string> names;
  for (std::int64_t target : compiled_targets()) {
    const ScopedTarget scope(target);
    names.insert(simd_target());
    EXPECT_STREQ(simd_target(), hwy::TargetName(target));
    test::TriangleSource random(21);
    for (double radius : {1e-300, 1e-9, 1.0, 1e6, 1e300})
      for (double offset : {0.0, 1e6}) {
        const auto nodes =
            random_nodes(random, shape->node_count(), Vec3::Constant(offset), radius);
        EXPECT_EQ(different_vertices(*shape, nodes), 0u) << simd_target() << " " << radius;
      }
  }
  EXPECT_EQ(names.size(), compiled_targets().size());
}

TEST(Mapping, BatchIsRightForEveryNumberOfVerticesInACell) {
  for (std::int64_t target : compiled_targets()) {
    const ScopedTarget scope(target);
    test::TriangleSource random(22);
    for (int count = 3; count <= 20; ++count) {
      TriangleMesh mesh;
      for (int v = 0; v < count; ++v) mesh.vertices.push_back(random.point(Vec3::Zero(), 1.0));
      for (std::uint32_t v = 2; v < mesh.vertices.size(); ++v)
        mesh.triangles.push_back({v - 2, v - 1, v});
      const auto shape = make_shape(mesh, {1, 1, 1});
      const auto nodes = random_nodes(random, 8, Vec3::Zero(), 1.0);
      EXPECT_EQ(different_vertices(*shape, nodes), 0u) << simd_target() << " " << count;
    }
  }
}

std::vector<LocalBox> random_boxes(test::TriangleSource& random, std::size_t cells) {
  std::vector<LocalBox> boxes;
  for (std::uint32_t i = 0; i < 60; ++i) {
    LocalBox box;
    box.home = static_cast<std::uint32_t>(random.below(static_cast<int>(cells)));
    const int kind = random.below(3);  // a point, a box with sides at 0 or 1, any box
    for (int corner = 0; corner < (kind == 0 ? 1 : 2); ++corner)
      box.local.extend(kind == 1 ? Vec3(corner, random.below(2), corner)
                                 : Vec3(random.point(Vec3::Zero(), 1.0).cwiseAbs()));
    boxes.push_back(box);
  }
  return boxes;
}

TEST(Mapping, BoxesGiveTheBitsOfThePointVersion) {
  const auto shape = make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 1), {4, 4, 4});
  const Lattice& lattice = *shape->lattice;
  for (std::int64_t target : compiled_targets()) {
    const ScopedTarget scope(target);
    test::TriangleSource random(26);
    const auto boxes = random_boxes(random, lattice.cells.size());
    const auto nodes = random_nodes(random, shape->node_count(), Vec3::Constant(10.0), 1.0);
    std::vector<Corners> mapped(boxes.size());
    map_boxes(lattice, boxes, nodes, mapped);
    std::size_t different = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (int c = 0; c < 8; ++c) {
        Vec3 local;
        for (int k = 0; k < 3; ++k)
          local[k] = (c >> k & 1) ? boxes[i].local.hi[k] : boxes[i].local.lo[k];
        const Vec3 expected = map_point(corners_of(lattice, boxes[i].home, nodes), local);
        different += !same_bits(mapped[i][c], expected);
      }
    EXPECT_EQ(different, 0u) << simd_target();
  }
}

TEST(Mapping, CornersGiveNodeBitsExactly) {
  test::TriangleSource random(23);
  for (int round = 0; round < 200; ++round) {
    Corners corners;
    for (Vec3& c : corners) c = random.point(Vec3::Constant(round % 2 ? 1e6 : 0.0), 1.0);
    for (int c = 0; c < 8; ++c) {
      const Vec3 local(c & 1, c >> 1 & 1, c >> 2 & 1);
      EXPECT_TRUE(same_bits(map_point(corners, local), corners[c]));
    }
  }
}

TEST(Mapping, UndeformedNodesGiveTheRestVerticesUpToRounding) {
  const TriangleMesh mesh = test::sphere_mesh({1, 2, 3}, 1.0, 2);
  const auto shape = make_shape(mesh, {4, 4, 4});
  std::vector<Vec3> mapped(mesh.vertices.size());
  map_vertices(*shape->lattice, shape->embedding, shape->lattice->rest_nodes(), mapped);
  for (std::size_t v = 0; v < mapped.size(); ++v)
    EXPECT_LT((mapped[v] - mesh.vertices[v]).norm(), 4e-15);
}

TEST(Mapping, HandComputedPoint) {
  Corners corners;
  for (int c = 0; c < 8; ++c) corners[c] = Vec3(c & 1, c >> 1 & 1, c >> 2 & 1);
  corners[7] = Vec3(9, 1, 1);  // one corner pulled along x: adds 8 s t u
  EXPECT_EQ(map_point(corners, {0.5, 0.5, 0.5}), Vec3(1.5, 0.5, 0.5));
  EXPECT_EQ(map_point(corners, {0.25, 0.5, 1.0}), Vec3(1.25, 0.5, 1.0));
}

Wide exact_coordinate(const Corners& c, const Vec3& local, int k) {
  Wide out = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Wide weight = 1;
    for (int axis = 0; axis < 3; ++axis)
      weight *= (corner >> axis & 1) ? Wide(local[axis]) : Wide(1) - Wide(local[axis]);
    out += weight * Wide(c[corner][k]);
  }
  return out;
}

// The largest error of map_point in shares of the bound, over random corners and coordinates.
double largest_error_share(test::TriangleSource& random, const Vec3& center, double radius) {
  double worst = 0.0;
  for (int round = 0; round < 3000; ++round) {
    Corners corners;
    double largest = 0.0;
    for (Vec3& c : corners) {
      c = random.point(center, radius);
      largest = std::max(largest, c.cwiseAbs().maxCoeff());
    }
    const Vec3 local = (random.point(Vec3::Zero(), 1.0)).cwiseAbs();
    const Vec3 mapped = map_point(corners, local);
    for (int k = 0; k < 3; ++k) {
      Wide error = Wide(mapped[k]) - exact_coordinate(corners, local, k);
      if (error < 0) error = -error;
      worst = std::max(worst, static_cast<double>(error / Wide(mapping_error_bound(largest))));
    }
  }
  return worst;
}

TEST(Mapping, ErrorStaysWithinItsBound) {
  test::TriangleSource random(24);
  for (double radius : {1e-2, 1.0, 1e9})
    for (double offset : {0.0, 1.0, 1e6, -1e12}) {
      const double share = largest_error_share(random, Vec3::Constant(offset), radius);
      EXPECT_LE(share, 1.0) << radius << " " << offset;
      // Not so loose that a forgotten rounding step would go unseen.
      EXPECT_GT(share, 0.05) << radius << " " << offset;
    }
}

TEST(Mapping, ErrorBoundCoversUnderflow) {
  test::TriangleSource random(25);
  for (double radius : {0x1p-1074, 0x1p-1070, 0x1p-1050, 0x1p-1022})
    EXPECT_LE(largest_error_share(random, Vec3::Zero(), radius), 1.0) << radius;
}

}  // namespace
}  // namespace contactcheck
