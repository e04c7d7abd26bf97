#include <gmock/gmock.h>

#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<BodyPair> bodies_in_contact(const std::string& name, const World& world) {
  return ask(*prepared(name, world), Question::kBody).bodies;
}

/// Octahedra of which a tip of each is `gap` from the other's, on the x axis.
World tips_apart(double gap) {
  return World({sphere_mesh(Vec3(0, 0, 0), 1, 0), sphere_mesh(Vec3(2 + gap, 0, 0), 1, 0)});
}

TEST(BulletCl, ClaimsBodiesByHulls) {
  const Semantics semantics = make_detector("bullet-cl:margin=0.25,scale=1")->semantics();
  EXPECT_THAT(semantics.levels, ElementsAre(Level::kBody, Level::kSelfBody));
  EXPECT_THAT(semantics.informative, IsEmpty());
  EXPECT_THAT(semantics.questions, ElementsAre(Question::kBody, Question::kSelf));
  EXPECT_EQ(semantics.depth, DepthKind::kNone);
  EXPECT_EQ(semantics.margin, 0.5);
  EXPECT_THAT(semantics.means, ::testing::HasSubstr("convex hulls"));
}

TEST(BulletCl, ShellWithinAnotherIsFalselyInContact) {
  const World world({sphere_mesh(Vec3(0, 0, 0), 1, 4), sphere_mesh(Vec3(0, 0, 0), 0.98, 4)});
  EXPECT_THAT(bodies_in_contact("bullet-cl", world), ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(bodies_in_contact("bullet-vf", world), IsEmpty());
}

// One cluster's hull is the whole ball; more of them follow its surface.
TEST(BulletCl, MoreClustersHoldLessSpace) {
  const World world({sphere_mesh(Vec3(0, 0, 0), 1, 4), sphere_mesh(Vec3(0, 0, 0), 0.2, 3)});
  EXPECT_THAT(bodies_in_contact("bullet-cl:k=1", world), ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(bodies_in_contact("bullet-cl", world), IsEmpty());
}

TEST(BulletCl, MarginsOfBothBodiesAddUp) {
  const World world = tips_apart(0.03);
  EXPECT_THAT(bodies_in_contact("bullet-cl", world), IsEmpty());
  EXPECT_THAT(bodies_in_contact("bullet-cl:margin=0.014", world), IsEmpty());
  EXPECT_THAT(bodies_in_contact("bullet-cl:margin=0.016", world), ElementsAre(BodyPair{0, 1}));
}

// Bullet alone grows a cluster's box only once it has left its old one.
TEST(BulletCl, ContactWithinTheMarginDoesNotDependOnTheFramesBefore) {
  World world = tips_apart(0.03);
  const auto detector = prepared("bullet-cl:margin=0.016", world);
  const World start = world;
  for (const double x : {0.02, -0.01, 5.0, -5.0, 0.0}) {
    shift(world, 1, Vec3(x, 0, 0));
    detector->update(world.frame());
    EXPECT_EQ(ask(*detector, Question::kBody).bodies,
              bodies_in_contact("bullet-cl:margin=0.016", world));
  }
  detector->update(start.frame());
  EXPECT_THAT(ask(*detector, Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
}

TEST(BulletCl, SwappedBodiesGiveTheSameAnswer) {
  for (const double gap : {0.001, 0.003}) {
    const World world = tips_apart(gap);
    const World swapped({world.bodies[1].shape->mesh, world.bodies[0].shape->mesh});
    EXPECT_THAT(bodies_in_contact("bullet-cl", world), SizeIs(gap < 0.002 ? 1 : 0));
    EXPECT_EQ(bodies_in_contact("bullet-cl", swapped), bodies_in_contact("bullet-cl", world));
  }
}

TEST(BulletCl, DisconnectedAndDegenerateMeshIsDivided) {
  // Two components, a triangle that repeats an index, one without area.
  const TriangleMesh mesh = {{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(20, 0, 0),
                              Vec3(24, 0, 0), Vec3(20, 4, 0), Vec3(22, 0, 0)},
                             {{0, 0, 1}, {0, 1, 2}, {3, 6, 4}, {3, 4, 5}}};
  const TriangleMesh probe = triangle_mesh(Vec3(21, 1, -1), Vec3(21, 1, 1), Vec3(21, 1.5, 1));
  EXPECT_THAT(bodies_in_contact("bullet-cl", World({mesh, probe})), ElementsAre(BodyPair{0, 1}));
}

// Bullet's own flag for it, CL_SELF, would end all collisions of the body.
TEST(BulletCl, ComparesABodysClustersThatShareNoVertex) {
  const TriangleMesh ball = sphere_mesh(Vec3(0, 0, 0), 1, 3);
  const std::size_t first = ball.vertices.size();
  World world(
      {together(ball, sphere_mesh(Vec3(2.1, 0, 0), 1, 3)), sphere_mesh(Vec3(0, 1.5, 0), 1, 3)});
  const auto detector = prepared("bullet-cl", world);
  EXPECT_THAT(ask(*detector, Question::kSelf).self_bodies, IsEmpty());
  for (std::size_t v = first; v < world.vertices[0].size(); ++v) world.vertices[0][v].x() -= 0.3;
  detector->update(world.frame());
  EXPECT_THAT(ask(*detector, Question::kSelf).self_bodies, ElementsAre(0u));
  EXPECT_THAT(ask(*detector, Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
}

/// A thin triangle through the middle of another.
TriangleMesh needle_through(const TriangleMesh& mesh, std::size_t triangle) {
  const auto [i, j, k] = mesh.triangles[triangle];
  const Vec3 center = (mesh.vertices[i] + mesh.vertices[j] + mesh.vertices[k]) / 3.0;
  const Vec3 out = 0.002 * center.normalized();
  return triangle_mesh(center - out, center + out, center + out + Vec3(0, 0, 0.001));
}

// generateClusters() of Bullet 3.24 crashes on this one. Of the needles some stand where two
// clusters meet: a triangle that belonged to neither would be a gap.
TEST(BulletCl, HundredThousandVerticesAreDividedWithoutGaps) {
  const TriangleMesh big = grid_sphere(1.0, 224);
  ASSERT_EQ(big.vertices.size(), 99906u);
  std::vector<TriangleMesh> meshes = {big};
  std::vector<BodyPair> expected;
  for (std::size_t t = 0; t < big.triangles.size(); t += 211) {
    if (std::abs(big.vertices[big.triangles[t][0]].z()) > 0.9) continue;  // crowded there
    expected.push_back({0, static_cast<std::uint32_t>(meshes.size())});
    meshes.push_back(needle_through(big, t));
  }
  ASSERT_GT(expected.size(), 500u);
  meshes.push_back(sphere_mesh(Vec3(0, 0, 0), 0.1, 2));  // the clusters follow the surface
  const World world(meshes);
  const auto detector = prepared("bullet-cl:margin=0.0001", world);
  EXPECT_EQ(ask(*detector, Question::kBody).bodies, expected);
  EXPECT_THAT(ask(*detector, Question::kSelf).self_bodies, IsEmpty());  // neighbours share some
  EXPECT_THAT(detector->notes(), SizeIs(1));
  EXPECT_THAT(prepared("bullet-cl", tips_apart(1))->notes(), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::test
