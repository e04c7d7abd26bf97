#include "core/broad/aabb_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using test::FrameData;

Aabb box_of(const TriangleMesh& mesh, const std::vector<Vec3>& vertices, std::uint32_t t) {
  Aabb box;
  for (std::uint32_t v : mesh.triangles[t]) box.extend(vertices[v]);
  return box;
}

/// Pairs of triangles whose boxes overlap, each against each.
std::vector<ElementPair> box_pairs(const std::vector<Body>& bodies, const FrameData& frame) {
  std::vector<ElementPair> out;
  const auto box = [&](std::uint32_t body, std::uint32_t t) {
    return box_of(bodies[body].shape->mesh, frame.vertices[body], t);
  };
  for (std::uint32_t a = 0; a < bodies.size(); ++a)
    for (std::uint32_t b = a + 1; b < bodies.size(); ++b)
      for (std::uint32_t i = 0; i < bodies[a].shape->mesh.triangles.size(); ++i)
        for (std::uint32_t j = 0; j < bodies[b].shape->mesh.triangles.size(); ++j)
          if (box(a, i).overlaps(box(b, j))) out.push_back({a, b, i, j});
  return out;
}

/// Sorted, but with repeats, should there be any.
std::vector<ElementPair> candidates(AabbTrees& trees) {
  std::vector<ElementPair> out;
  trees.visit_candidates([&](const ElementPair& pair) {
    out.push_back(pair);
    return false;
  });
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Body> three_bodies() {
  const auto ball = make_bare_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 2));
  return {{"ball", ball}, {"box", make_bare_shape(test::unit_box_mesh(3))}, {"again", ball}};
}

FrameData frame_at(const std::vector<Body>& bodies, test::TriangleSource& random, double wobble) {
  FrameData frame;
  for (const Body& body : bodies) {
    frame.vertices.push_back(body.shape->mesh.vertices);
    const Vec3 at = random.point(Vec3::Zero(), 1.0);
    for (Vec3& v : frame.vertices.back()) v = random.point(v + at, wobble);
  }
  frame.nodes = frame.vertices;
  return frame;
}

TEST(AabbTree, BoxesAreTheTightestAfterAnyMotion) {
  test::TriangleSource random(401);
  const TriangleMesh mesh = test::sphere_mesh(Vec3::Zero(), 1.0, 2);
  const auto shape = std::make_shared<TriangleTree>(make_triangle_tree(mesh, 3));
  AabbTree tree(shape);
  for (double scale : {1.0, 0.0, 1e-300, 1e300, 30.0}) {
    std::vector<Vec3> vertices = mesh.vertices;
    for (Vec3& v : vertices) v = scale * random.point(v, 1.0);
    tree.refit(vertices);
    EXPECT_EQ(tree.validate(vertices), "") << scale;
    EXPECT_EQ(tree.box(0).lo, bounding_box(vertices).lo) << scale;
    EXPECT_EQ(tree.box(0).hi, bounding_box(vertices).hi) << scale;
    for (std::uint32_t slot = 0; slot < shape->ids.size(); ++slot) {
      const Aabb expected = box_of(mesh, vertices, shape->ids[slot]);
      EXPECT_EQ(tree.triangle_box(slot).lo, expected.lo);
      EXPECT_EQ(tree.triangle_box(slot).hi, expected.hi);
    }
  }
}

TEST(AabbTree, ValidateSeesVerticesThatLeftTheirBoxes) {
  const TriangleMesh mesh = test::unit_box_mesh(2);
  AabbTree tree(std::make_shared<TriangleTree>(make_triangle_tree(mesh, 4)));
  tree.refit(mesh.vertices);
  std::vector<Vec3> moved = mesh.vertices;
  EXPECT_EQ(tree.validate(moved), "");
  moved[5].x() += 2.0;
  EXPECT_NE(tree.validate(moved), "");
}

TEST(AabbTrees, CandidatesAreThePairsOfOverlappingBoxesOnceEach) {
  test::TriangleSource random(402);
  const std::vector<Body> bodies = three_bodies();
  for (std::uint32_t leaf : {1u, 4u, 64u}) {
    AabbTrees trees(leaf);
    trees.prepare(bodies);
    for (double wobble : {0.0, 0.05, 1.0}) {
      const FrameData frame = frame_at(bodies, random, wobble);
      trees.update({frame.vertices.begin(), frame.vertices.end()});
      const std::vector<ElementPair> expected = box_pairs(bodies, frame);
      ASSERT_GT(expected.size(), 100u);
      EXPECT_EQ(candidates(trees), expected) << leaf << " " << wobble;
      EXPECT_GT(trees.visited(), expected.size());
    }
  }
}

TEST(AabbTrees, EnoughOfTwoBodiesIsNotEnoughOfOthers) {
  test::TriangleSource random(403);
  const std::vector<Body> bodies = three_bodies();
  AabbTrees trees(4);
  trees.prepare(bodies);
  FrameData frame = frame_at(bodies, random, 0.05);
  frame.vertices[2] = frame.vertices[0];
  for (Vec3& v : frame.vertices[1]) v += frame.vertices[0][0] - frame.vertices[1][0];
  trees.update({frame.vertices.begin(), frame.vertices.end()});
  candidates(trees);
  const std::uint64_t all = trees.visited();
  std::vector<BodyPair> pairs;
  trees.visit_candidates([&](const ElementPair& pair) {
    pairs.push_back({pair.body_a, pair.body_b});
    return true;
  });
  EXPECT_EQ(pairs, (std::vector<BodyPair>{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_LT(trees.visited(), all / 2);
}

TEST(AabbTrees, BodiesApartAreToldByTheirRoots) {
  const std::vector<Body> bodies = three_bodies();
  AabbTrees trees(4);
  trees.prepare(bodies);
  FrameData frame;
  for (const Body& body : bodies) {
    frame.vertices.push_back(body.shape->mesh.vertices);
    for (Vec3& v : frame.vertices.back()) v.x() += 9.0 * static_cast<double>(frame.vertices.size());
  }
  frame.nodes = frame.vertices;
  trees.update({frame.vertices.begin(), frame.vertices.end()});
  EXPECT_TRUE(candidates(trees).empty());
  EXPECT_EQ(trees.visited(), 3u);
}

}  // namespace
}  // namespace contactcheck
