// The paper's element test, and what it cannot see.

#include "core/narrow/node_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/deform/ffd_aabb.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::Scene;

std::array<Vec3, 8> box_corners(const Vec3& lo, const Vec3& hi) {
  std::array<Vec3, 8> corners;
  for (int c = 0; c < 8; ++c)
    corners[c] = {(c & 1) ? hi.x() : lo.x(), (c & 2) ? hi.y() : lo.y(), (c & 4) ? hi.z() : lo.z()};
  return corners;
}

const BoxPlanes kUnitBox = planes_of_box(box_corners(Vec3::Zero(), Vec3::Ones()));

TEST(NodePlane, NormalsPointOutwardAtRest) {
  for (int f = 0; f < 6; ++f)
    EXPECT_GT(kUnitBox.normal[f].dot(kUnitBox.point[f] - Vec3::Constant(0.5)), 0.0) << f;
}

TEST(NodePlane, NodeOnAPlaneCountsAsInside) {
  EXPECT_TRUE(node_inside(kUnitBox, {0.25, 0.25, 0.25}));
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {0.0, 1.0}) {
      Vec3 node = Vec3::Constant(0.25);
      node[axis] = side;
      EXPECT_TRUE(node_inside(kUnitBox, node));
      node[axis] = side + (side > 0 ? 1e-15 : -1e-300);
      EXPECT_FALSE(node_inside(kUnitBox, node));
    }
  EXPECT_TRUE(node_inside(kUnitBox, {1, 1, 1}));
}

TEST(NodePlane, FlatBoxExcludesOnlyWhatIsOffItsPlane) {
  const BoxPlanes flat = planes_of_box(box_corners({0.5, 0, 0}, {0.5, 1, 1}));
  EXPECT_TRUE(node_inside(flat, {0.5, 0.5, 0.5}));
  EXPECT_FALSE(node_inside(flat, {0.75, 0.5, 0.5}));
  EXPECT_TRUE(node_inside(flat, {0.5, 90, -90}));  // its other faces have no area
}

TEST(NodePlane, BoxThatIsAPointExcludesNothing) {
  const BoxPlanes point = planes_of_box(box_corners(Vec3::Ones(), Vec3::Ones()));
  EXPECT_TRUE(node_inside(point, {1, 1, 1}));
  EXPECT_TRUE(node_inside(point, {1e9, -7, 0}));
}

TEST(NodePlane, BoxTurnedInsideOutExcludesItsOwnMiddle) {
  const BoxPlanes mirrored = planes_of_box(box_corners({1, 0, 0}, {0, 1, 1}));
  EXPECT_FALSE(node_inside(mirrored, Vec3::Constant(0.5)));
}

// Boxes that stand for each kept cell of a body, in a frame.
std::vector<Corners> boxes_of(const BodyShape& shape, bool tight, const std::vector<Vec3>& nodes) {
  std::vector<Aabb> local(shape.lattice->cells.size(), {Vec3::Zero(), Vec3::Ones()});
  if (tight) local = ffd_aabbs(shape.mesh, *shape.lattice, shape.embedding);
  std::vector<Corners> boxes;
  for (std::uint32_t cell = 0; cell < local.size(); ++cell)
    boxes.push_back(mapped_box(*shape.lattice, cell, local[cell], nodes));
  return boxes;
}

bool any_inside(const Corners& nodes, const Corners& box) {
  const BoxPlanes planes = planes_of_box(box);
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](const Vec3& n) { return node_inside(planes, n); });
}

std::vector<ElementPair> cell_pairs(const Scene& scene, const test::FrameData& frame, bool tight) {
  const auto a = boxes_of(*scene.bodies[0].shape, tight, frame.nodes[0]);
  const auto b = boxes_of(*scene.bodies[1].shape, tight, frame.nodes[1]);
  std::vector<ElementPair> pairs;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (any_inside(a[i], b[j]) || any_inside(b[j], a[i])) pairs.push_back({0, 1, i, j});
  return pairs;
}

TEST(NodePlaneStage, EqualsBruteForceWhereAllNodesShareABucket) {
  std::size_t pairs = 0, all = 0;
  for (std::uint64_t seed : {501, 502, 503}) {
    const Scene scene = test::approach({seed, 0.3, 1.0, Vec3(50, 50, 50)});
    const auto grid = test::prepared("ffd-grid:cell=1000", scene);
    const auto aabb = test::prepared("ffd-aabb:cell=1000", scene);
    for (const test::FrameData& frame : scene.frames) {
      const auto expected = cell_pairs(scene, frame, true);
      EXPECT_EQ(test::answer(*grid, frame).cells, cell_pairs(scene, frame, false));
      EXPECT_EQ(test::answer(*aabb, frame).cells, expected);
      pairs += expected.size();
      all += scene.bodies[0].shape->lattice->cells.size() *
             scene.bodies[1].shape->lattice->cells.size();
    }
  }
  EXPECT_GT(pairs, 100u);
  EXPECT_LT(pairs, all / 3);
}

TEST(NodePlaneStage, BucketsAndSpheresOnlyTakeAway) {
  std::size_t with_all = 0, with_buckets = 0;
  for (std::uint64_t seed : {504, 505}) {
    const Scene scene = test::approach({seed, 0.3, 1.0, Vec3(50, 50, 50)});
    for (const test::FrameData& frame : scene.frames) {
      const auto all = cell_pairs(scene, frame, true);
      for (const char* name : {"ffd-aabb", "ffd-aabb-sphere", "ffd-aabb-sphere2"}) {
        const auto found = test::answer(*test::prepared(name, scene), frame).cells;
        EXPECT_TRUE(std::includes(all.begin(), all.end(), found.begin(), found.end())) << name;
        with_buckets += found.size();
        with_all += all.size();
      }
    }
  }
  EXPECT_GT(with_buckets, 0u);
  EXPECT_LT(with_buckets, with_all);
}

TEST(NodePlaneStage, CrossingBarsAreMissedAsNoNodeIsInside) {
  Scene scene;
  scene.bodies = {
      test::make_body("along x", test::box_mesh({-3, -0.5, -0.5}, {3, 0.5, 0.5}, 1), {1, 1, 1}),
      test::make_body("along y", test::box_mesh({-0.5, -3, -0.5}, {0.5, 3, 0.5}, 1), {1, 1, 1})};
  const Vec3 at(50, 50, 50);
  scene.frames.push_back(test::make_frame(
      scene.bodies, {test::rest_nodes_at(*scene.bodies[0].shape, at),
                     test::rest_nodes_at(*scene.bodies[1].shape, at + Vec3(0, 0, 0.25))}));
  EXPECT_FALSE(test::true_pairs(scene, scene.frames[0]).empty());
  for (const std::string& name : test::family())
    for (const char* bounds : {":bounds=paper,cell=100", ":bounds=safe"}) {
      const auto detector = test::prepared(name + bounds, scene);
      const ContactSet found = test::answer(*detector, scene.frames[0]);
      EXPECT_TRUE(found.cells.empty() && found.bodies.empty()) << name << bounds;
    }
}

}  // namespace
}  // namespace contactcheck
