#include "core/broad/triangle_sphere_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <type_traits>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"
#include "tests/support/wide.h"

namespace contactcheck {
namespace {

using test::FrameData;
using test::Wide;

template <typename T>
Wide squared_distance(const Vec3Of<T>& a, const Vec3Of<T>& b) {
  Wide sum = 0;
  for (int k = 0; k < 3; ++k) sum += (Wide(a[k]) - Wide(b[k])) * (Wide(a[k]) - Wide(b[k]));
  return sum;
}

/// In 113 bits; the bounds have 8 ulps of their precision to spare.
template <typename T>
bool holds(const SphereOf<T>& outer, const Vec3Of<T>& p) {
  return std::isinf(outer.radius) ||
         squared_distance<T>(outer.center, p) <= Wide(outer.radius) * Wide(outer.radius);
}

template <typename T>
bool holds(const SphereOf<T>& outer, const SphereOf<T>& inner) {
  if (std::isinf(outer.radius)) return true;
  const Wide room = Wide(outer.radius) - Wide(inner.radius);
  return room >= 0 && squared_distance<T>(outer.center, inner.center) <= room * room;
}

/// "" or which sphere does not hold a vertex of a triangle below it.
template <typename T>
std::string fault(const TriangleSphereTreeOf<T>& tree, const std::vector<Vec3Of<T>>& vertices,
                  std::uint32_t top = 0) {
  std::vector<std::uint32_t> open = {top};
  const SphereOf<T>& sphere = tree.sphere(top);
  bool good = sphere.center.allFinite() && sphere.radius >= 0;
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

/// Scales from the smallest number to where squares overflow.
template <typename T>
std::vector<double> scales() {
  if constexpr (std::is_same_v<T, float>) {
    return {1.0, 0.0, 0x1p-149, 1e-40, 1e-25, 1e-12, 30.0, 0x1p40, 1e19, 1e38};
  } else {
    return {1.0, 0.0, 0x1p-1074, 1e-300, 1e-160, 1e155, 8e307, 30.0};
  }
}

template <typename T>
class Spheres : public ::testing::Test {
 protected:
  static constexpr T kInfinity = std::numeric_limits<T>::infinity();
  static constexpr T kUnit = std::numeric_limits<T>::epsilon() / 2;

  static SphereOf<T> random_sphere(test::TriangleSource& random, double offset) {
    return {random.point(Vec3::Constant(offset), 1.0).template cast<T>(),
            static_cast<T>(std::abs(random.unit()))};
  }
};
using Precisions = ::testing::Types<double, float>;
TYPED_TEST_SUITE(Spheres, Precisions);

TYPED_TEST(Spheres, EnclosingTwoHoldBothAndAreTheSmallest) {
  using T = TypeParam;
  test::TriangleSource random(501);
  for (int round = 0; round < 5000; ++round) {
    const double offset = round % 3 == 0 ? 1e6 : 0.0;
    const SphereOf<T> a = this->random_sphere(random, offset);
    const SphereOf<T> b = this->random_sphere(random, offset);
    const SphereOf<T> both = enclosing_sphere(a, b);
    EXPECT_TRUE(holds(both, a) && holds(both, b)) << round;
    const T distance = (a.center - b.center).norm();
    const T smallest = std::max({a.radius, b.radius, (distance + a.radius + b.radius) / 2});
    EXPECT_LE(both.radius, smallest + this->kUnit * static_cast<T>(90 + 9 * offset)) << round;
  }
}

TYPED_TEST(Spheres, EnclosingTwoHoldBothAtTheEndsOfTheRange) {
  using T = TypeParam;
  std::vector<double> all = scales<T>();
  all.push_back(0.9 * std::numeric_limits<T>::max());  // the distance of the centres overflows, too
  for (double scale : all) {
    const T x = static_cast<T>(scale);
    for (T radius : {T(0), T(1e-30), T(1), T(1e19), this->kInfinity}) {
      const SphereOf<T> a{Vec3Of<T>(-x, x, 0), radius}, b{Vec3Of<T>(x, -x, x), radius / 2};
      for (const SphereOf<T>& both : {enclosing_sphere(a, b), enclosing_sphere(b, a)}) {
        EXPECT_TRUE(both.center.allFinite()) << x << " " << radius;
        EXPECT_TRUE(both.radius > 0) << x << " " << radius;
        EXPECT_TRUE(holds(both, a) && holds(both, b)) << x << " " << radius;
      }
    }
  }
}

TYPED_TEST(Spheres, EnclosingABoxHoldItAndAreTheSmallest) {
  using T = TypeParam;
  test::TriangleSource random(503);
  const std::vector<double> all = scales<T>();
  for (int round = 0; round < 3000; ++round) {
    const double scale = all[round % all.size()];
    const Aabb plain = random.box(Vec3::Constant(round % 3), 1.0);
    if (!(scale * 4.0 < std::numeric_limits<T>::max())) continue;
    const AabbOf<T> box{(scale * plain.lo).template cast<T>(),
                        (scale * plain.hi).template cast<T>()};
    const SphereOf<T> sphere = enclosing_sphere(box);
    for (int c = 0; c < 8; ++c)
      EXPECT_TRUE(
          holds(sphere, Vec3Of<T>((c & 1 ? box.hi : box.lo).x(), (c & 2 ? box.hi : box.lo).y(),
                                  (c & 4 ? box.hi : box.lo).z())));
    if (scale == 1.0) {
      EXPECT_LE(sphere.radius, box.extent().norm() / 2 + 90 * this->kUnit);
    }
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

TYPED_TEST(Spheres, OfATreeHoldTheirPartsAfterAnyMotion) {
  using T = TypeParam;
  test::TriangleSource random(502);
  const TriangleMesh mesh = test::sphere_mesh(Vec3::Zero(), 1.0, 2);
  for (std::uint32_t leaf : {1u, 4u}) {
    TriangleSphereTreeOf<T> tree(std::make_shared<TriangleTree>(make_triangle_tree(mesh, leaf)));
    for (double scale : scales<T>()) {
      std::vector<Vec3Of<T>> vertices;
      for (const Vec3& v : mesh.vertices)
        vertices.push_back((scale * random.point(v, 1.0)).template cast<T>());
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
  trees.update({frame.vertices.begin(), frame.vertices.end()});
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
  trees.update({deep.vertices.begin(), deep.vertices.end()});
  int calls = 0;
  trees.visit_candidates([&](const ElementPair&) { return ++calls == 3; });
  EXPECT_EQ(calls, 3);
  trees.update({apart.vertices.begin(), apart.vertices.end()});
  trees.visit_candidates([&](const ElementPair&) { return ++calls == 4; });
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(trees.visited(), 1u);
}

}  // namespace
}  // namespace contactcheck
