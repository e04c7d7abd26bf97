#include "core/broad/triangle_sphere_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"
#include "tests/support/wide.h"

namespace contactcheck {
namespace {

using test::FrameData;
using test::Wide;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Wide squared_distance(const Vec3& a, const Vec3& b) {
  Wide sum = 0;
  for (int k = 0; k < 3; ++k) sum += (Wide(a[k]) - Wide(b[k])) * (Wide(a[k]) - Wide(b[k]));
  return sum;
}

/// In 113 bits; the bounds have 8 ulps of a double to spare.
bool holds(const Sphere& outer, const Vec3& p) {
  return std::isinf(outer.radius) ||
         squared_distance(outer.center, p) <= Wide(outer.radius) * Wide(outer.radius);
}

bool holds(const Sphere& outer, const Sphere& inner) {
  if (std::isinf(outer.radius)) return true;
  const Wide room = Wide(outer.radius) - Wide(inner.radius);
  return room >= 0 && squared_distance(outer.center, inner.center) <= room * room;
}

/// "" or which sphere does not hold a vertex of a triangle below it.
std::string fault(const TriangleSphereTree& tree, const std::vector<Vec3>& vertices,
                  std::uint32_t top = 0) {
  std::vector<std::uint32_t> open = {top};
  const Sphere& sphere = tree.sphere(top);
  bool good = sphere.center.allFinite() && sphere.radius >= 0.0;
  while (!open.empty() && good) {
    const TriangleTree::Node node = tree.tree().nodes[open.back()];
    open.pop_back();
    if (!node.leaf()) open.insert(open.end(), {node.first, node.first + 1});
    for (std::uint32_t s = node.first; s < node.first + node.count; ++s)
      for (std::uint32_t v : tree.tree().corners[s]) good = good && holds(sphere, vertices[v]);
  }
  if (!good) return "node " + std::to_string(top);
  return top + 1 < tree.tree().nodes.size() ? fault(tree, vertices, top + 1) : "";
}

TEST(EnclosingSphere, HoldsBothAndIsTheSmallest) {
  test::TriangleSource random(501);
  for (int round = 0; round < 5000; ++round) {
    const double offset = round % 3 == 0 ? 1e6 : 0.0;
    const Sphere a{random.point(Vec3::Constant(offset), 1.0), std::abs(random.unit())};
    const Sphere b{random.point(Vec3::Constant(offset), 1.0), std::abs(random.unit())};
    const Sphere both = enclosing_sphere(a, b);
    EXPECT_TRUE(holds(both, a) && holds(both, b)) << round;
    const double distance = (a.center - b.center).norm();
    const double smallest = std::max({a.radius, b.radius, 0.5 * (distance + a.radius + b.radius)});
    EXPECT_LE(both.radius, smallest + 1e-14 + 1e-15 * offset) << round;
  }
}

TEST(EnclosingSphere, OfOneInsideTheOtherIsTheOuter) {
  const Sphere outer{Vec3(1, 2, 3), 2.0}, inner{Vec3(1.5, 2, 3), 0.25};
  for (const Sphere& both : {enclosing_sphere(outer, inner), enclosing_sphere(inner, outer)}) {
    EXPECT_EQ(both.center, outer.center);
    EXPECT_GE(both.radius, 2.0);
    EXPECT_LE(both.radius, 2.0 + 1e-14);
  }
  const Sphere same = enclosing_sphere(outer, outer);
  EXPECT_TRUE(holds(same, outer));
  EXPECT_LE(same.radius, 2.0 + 1e-14);
}

TEST(EnclosingSphere, HoldsBothAtTheEndsOfTheRange) {
  for (double x : {0x1p-1074, 1e-300, 1e-160, 1e150, 1e160, 1.7e308}) {
    for (double radius : {0.0, 1e-170, 1.0, 1e150, kInfinity}) {
      const Sphere a{Vec3(-x, x, 0), radius}, b{Vec3(x, -x, x), 0.5 * radius};
      for (const Sphere& both : {enclosing_sphere(a, b), enclosing_sphere(b, a)}) {
        EXPECT_TRUE(both.center.allFinite()) << x << " " << radius;
        EXPECT_TRUE(both.radius > 0.0) << x << " " << radius;
        EXPECT_TRUE(holds(both, a) && holds(both, b)) << x << " " << radius;
      }
    }
  }
}

TEST(EnclosingSphere, HoldsABoxAndIsTheSmallest) {
  test::TriangleSource random(503);
  for (int round = 0; round < 3000; ++round) {
    const double scale = std::vector{1.0, 1e-160, 1e-300, 1e160, 1e300}[round % 5];
    Aabb box = random.box(Vec3::Constant(round % 3), 1.0);
    box.lo *= scale;
    box.hi *= scale;
    const Sphere sphere = enclosing_sphere(box);
    for (int c = 0; c < 8; ++c)
      EXPECT_TRUE(holds(sphere, Vec3((c & 1 ? box.hi : box.lo).x(), (c & 2 ? box.hi : box.lo).y(),
                                     (c & 4 ? box.hi : box.lo).z())));
    if (scale == 1.0) {
      EXPECT_LE(sphere.radius, 0.5 * box.extent().norm() + 1e-14);
    }
  }
}

TEST(TriangleSphereTree, SpheresHoldTheirPartsAfterAnyMotion) {
  test::TriangleSource random(502);
  const TriangleMesh mesh = test::sphere_mesh(Vec3::Zero(), 1.0, 2);
  for (std::uint32_t leaf : {1u, 4u}) {
    TriangleSphereTree tree(std::make_shared<TriangleTree>(make_triangle_tree(mesh, leaf)));
    for (double scale : {1.0, 0.0, 0x1p-1074, 1e-300, 1e-160, 1e155, 8e307, 30.0}) {
      std::vector<Vec3> vertices = mesh.vertices;
      for (Vec3& v : vertices) v = scale * random.point(v, 1.0);
      tree.refit(vertices);
      EXPECT_EQ(fault(tree, vertices), "") << scale;
    }
  }
}

TEST(TriangleSphereTree, SpheresOfABallStayCloseToIt) {
  const TriangleMesh mesh = test::sphere_mesh(Vec3(5, 6, 7), 1.0, 3);
  TriangleSphereTree tree(std::make_shared<TriangleTree>(make_triangle_tree(mesh, 4)));
  tree.refit(mesh.vertices);
  EXPECT_LT(tree.sphere(0).radius, 1.75);  // sqrt(3): by its box; by spheres alone 2.65
  const std::vector<Vec3> point(mesh.vertices.size(), Vec3(1, 2, 3));
  tree.refit(point);
  EXPECT_LT(tree.sphere(0).radius, 1e-140);
  EXPECT_EQ(tree.sphere(0).center, Vec3(1, 2, 3));
}

std::vector<Body> two_balls() {
  const auto ball = make_bare_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 2));
  return {{"one", ball}, {"other", ball}};
}

FrameData apart_by(const std::vector<Body>& bodies, double x) {
  FrameData frame;
  for (const Body& body : bodies) {
    frame.vertices.push_back(body.shape->mesh.vertices);
    for (Vec3& v : frame.vertices.back()) v.x() += x * static_cast<double>(frame.vertices.size());
  }
  frame.nodes = frame.vertices;
  return frame;
}

TEST(TriangleSphereTrees, CandidatesAreAllPairsOfOverlappingLeavesOnceEach) {
  const std::vector<Body> bodies = two_balls();
  TriangleSphereTrees trees(4);
  trees.prepare(bodies);
  const FrameData frame = apart_by(bodies, 1.8);
  trees.update(frame.frame());
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> expected, got;
  const TriangleTree& tree = trees.tree(0).tree();
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
    for (std::uint32_t j = 0; j < tree.nodes.size(); ++j) {
      const TriangleTree::Node a = tree.nodes[i], b = tree.nodes[j];
      if (!a.leaf() || !b.leaf() || !trees.tree(0).overlap(i, trees.tree(1), j)) continue;
      for (std::uint32_t s = a.first; s < a.first + a.count; ++s)
        for (std::uint32_t t = b.first; t < b.first + b.count; ++t)
          expected.emplace(tree.ids[s], tree.ids[t]);
    }
  trees.visit_candidates([&](const ElementPair& pair) {
    got.emplace(pair.a, pair.b);
    return false;
  });
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(got, expected);
  EXPECT_LT(trees.visited(), tree.nodes.size() * tree.nodes.size() / 4);
}

TEST(TriangleSphereTrees, OneAnswerEndsTheTraversalOfTwoBodies) {
  const std::vector<Body> bodies = two_balls();
  TriangleSphereTrees trees(4);
  trees.prepare(bodies);
  const FrameData deep = apart_by(bodies, 0.5), apart = apart_by(bodies, 9.0);
  trees.update(deep.frame());
  int calls = 0;
  trees.visit_candidates([&](const ElementPair&) { return ++calls == 3; });
  EXPECT_EQ(calls, 3);
  trees.update(apart.frame());
  trees.visit_candidates([&](const ElementPair&) { return ++calls == 4; });
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(trees.visited(), 1u);
}

}  // namespace
}  // namespace contactcheck
