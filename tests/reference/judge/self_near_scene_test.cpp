// What the scene self-near is for: it comes to within a hundredth of its size of itself, and no
// more.
#include <gtest/gtest.h>

#include "reference/judge/judged_scene.h"
#include "reference/oracle/oracle.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {
namespace {

// Vertices that are near a triangle far away at rest: the ends of the C, and no neighbours.
std::size_t folded_pairs(const BodyShape& shape, const std::vector<NearPair>& near, double far) {
  std::size_t count = 0;
  for (const NearPair& p : near) {
    const Vec3& corner = shape.mesh.vertices[shape.mesh.triangles[p.triangle][0]];
    count += (corner - shape.mesh.vertices[p.vertex]).norm() > far ? 1 : 0;
  }
  return count;
}

TEST(SceneSelfNear, ComesWithinAHundredthOfItsSizeAndTouchesNothing) {
  const scene::Scene scene = scene::load_scene(CONTACTCHECK_FIXTURES "/scenes/self-near.json");
  const BodyShape& shape = *scene.bodies.at(0).shape;
  const double size = scene.size();
  oracle::Oracle oracle(scene.bodies);
  std::size_t within = 0, closer = 0, contacts = 0;
  for (std::size_t f = 0; f < scene.frames; ++f) {
    const auto nodes = scene.nodes_of_frame(f);
    const auto vertices = scene::map_bodies(scene, nodes);
    const Frame frame = make_frame(f, 0.0, nodes, vertices);
    contacts += oracle.judge(frame, {.self = true}).surface.self.size();
    within += folded_pairs(shape, oracle.self_near(frame, 0.01 * size), 0.2 * size);
    closer += folded_pairs(shape, oracle.self_near(frame, 0.008 * size), 0.2 * size);
  }
  EXPECT_EQ(contacts, 0u);
  EXPECT_GT(within, 10u);
  EXPECT_EQ(closer, 0u);
}

}  // namespace
}  // namespace contactcheck::judge
