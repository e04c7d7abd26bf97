#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/types/check.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::Scene;

Scene with_bare_body() {
  Scene scene = test::approach({601, 0.0}, 1);
  scene.bodies[1] = {"the statue", make_bare_shape(test::unit_box_mesh(1))};
  return scene;
}

TEST(Refusal, OfABodyWithoutALatticeNamesTheBody) {
  const Scene scene = with_bare_body();
  for (const std::string& name : test::family_with_triangles()) {
    try {
      test::prepared(name, scene);
      FAIL() << name << " took a body without a lattice";
    } catch (const RefusedInput& e) {
      EXPECT_STREQ(e.what(),
                   "body \"the statue\": the FFD-AABB family needs a lattice for every body");
    }
  }
}

TEST(SmallScenes, OfNoOrOneBodyHaveNoContact) {
  Scene none, one = test::approach({602, 0.3}, 1);
  none.frames.emplace_back();
  one.bodies.resize(1);
  one.frames[0] = test::make_frame(one.bodies, {one.frames[0].nodes[0]});
  for (const std::string& id : test::family())
    for (const char* variant : {"", "+tri", "+tri:bounds=paper"})
      for (const Scene* scene : {&none, &one}) {
        const auto detector = test::prepared(id + variant, *scene);
        const ContactSet found = test::answer(*detector, scene->frames[0]);
        EXPECT_TRUE(found.bodies.empty() && found.cells.empty() && found.triangles.empty());
      }
}

/// The first frame, scaled so that its largest coordinate of a node is `largest`.
FrameData scaled_to(const Scene& scene, double largest) {
  std::vector<std::vector<Vec3>> nodes = scene.frames[0].nodes;
  double now = 0.0;
  for (const auto& body : nodes)
    for (const Vec3& n : body) now = std::max(now, n.cwiseAbs().maxCoeff());
  for (auto& body : nodes)
    for (Vec3& n : body)
      for (int k = 0; k < 3; ++k)
        n[k] = std::abs(n[k]) == now ? std::copysign(largest, n[k]) : n[k] / now * largest;
  return test::make_frame(scene.bodies, std::move(nodes));
}

// Mean edges, and with them cells of the hash grid, were infinite: infinite boxes had no place in
// it, and their contacts were lost.
TEST(LargestDouble, IsAnsweredRightOrRefused) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  Scene deep = test::approach({604, 0.3}, 6);
  deep.frames = {deep.frames.back()};
  for (const std::string& name : test::exact_detectors()) {
    SCOPED_TRACE(name);
    for (const double share : {0.25, 0.75, 1 - 0x1p-40}) {
      const FrameData frame = scaled_to(deep, share * kLargest);
      ASSERT_FALSE(test::true_pairs(deep, frame).empty());
      const auto detector = test::prepared(name, deep);
      EXPECT_EQ(test::answer(*detector, frame).triangles, test::true_pairs(deep, frame)) << share;
    }
  }
  const FrameData frame = scaled_to(deep, kLargest);
  for (const std::string& id : test::family()) {
    const auto detector = test::prepared(id + "+tri", deep);
    try {
      EXPECT_EQ(test::answer(*detector, frame).triangles, test::true_pairs(deep, frame)) << id;
    } catch (const RefusedInput& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr("so near the largest double")) << id;
    }
  }
}

// One triangle, twice in one place, in a cell whose nodes are drawn to corners of the range.
TEST(LargestDouble, ATriangleWhoseBoxOverflowsIsFoundOrRefused) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const TriangleMesh mesh =
      test::triangle_mesh(Vec3(-1, 0, 0) * (kLargest / 2.2), Vec3(1, 1, 1) * (kLargest / 2.2),
                          Vec3(-1, 0, 1) * (kLargest / 2.2));
  Scene scene;
  for (int body = 0; body < 2; ++body)
    scene.bodies.push_back(test::make_body("a", mesh, {1, 1, 1}));
  const std::vector<Vec3> corners = {{1, -1, 1},  {0, -1, 1}, {0, 0, 1},   {0, 0, 1},
                                     {-1, -1, 1}, {1, 1, 1},  {-1, -1, 1}, {1, 0, 1}};
  std::vector<Vec3> nodes;
  for (const Vec3& corner : corners) nodes.push_back(corner * kLargest);
  const FrameData frame = test::make_frame(scene.bodies, {nodes, nodes});
  ASSERT_EQ(test::true_pairs(scene, frame).size(), 1u);
  for (const std::string& name : test::exact_detectors()) {
    const auto detector = test::prepared(name, scene);
    try {
      EXPECT_EQ(test::answer(*detector, frame).triangles.size(), 1u) << name;
    } catch (const RefusedInput& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr("so near the largest double")) << name;
    }
  }
}

TEST(FrameDeathTest, OfAnotherSizeThanTheSceneBreaksAPromise) {
  const Scene scene = test::approach({603, 0.3}, 1);
  const auto detector = test::prepared("ffd-aabb+tri", scene);
  Frame missing_body = scene.frames[0].frame(), missing_node = missing_body,
        missing_vertices = missing_body;
  missing_body.bodies.pop_back();
  missing_node.bodies[0].nodes = missing_node.bodies[0].nodes.first(3);
  missing_vertices.bodies[1].vertices = {};
  EXPECT_DEATH(detector->update(missing_body), "one state per prepared body");
  EXPECT_DEATH(detector->update(missing_node), "one position per node");
  EXPECT_DEATH(detector->update(missing_vertices), "one position per vertex");
}

}  // namespace
}  // namespace contactcheck
