#include <gmock/gmock.h>
#include <time.h>

#include <cmath>
#include <limits>
#include <thread>

#include "core/types/check.h"
#include "reference/adapters/bullet.h"
#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kGimpact = "bullet-gimpact";

World two_gimpact_spheres() {
  return World({sphere_mesh(Vec3(0, 0, 0), 1, 3), sphere_mesh(Vec3(1.1, 0.3, 0.2), 0.9, 3)});
}

std::vector<ElementPair> gimpact_triangles(const World& world, const std::string& name = kGimpact) {
  return ask(name, world, Question::kTriangles).triangles;
}

/// True pairs of the values that it is fed and that it does not report.
std::vector<ElementPair> missed(const World& world, const std::string& name = kGimpact) {
  const auto detector = prepared(name, world);
  const World seen = fed(world, detector->semantics().scale);
  return without(true_pairs(seen), ask(*detector, Question::kTriangles).triangles);
}

/// A floor and a triangle that stands on its tip, `height` above it.
World spike_over_floor(double height) {
  return World(
      {triangle_mesh(Vec3(-8, -8, 0), Vec3(8, -8, 0), Vec3(0, 8, 0)),
       triangle_mesh(Vec3(0, 0, height), Vec3(1, 0, height + 1), Vec3(-1, 0, height + 1))});
}

TEST(Gimpact, ClaimsTrianglesInSinglePrecisionAndSaysWhatContactIs) {
  const auto detector = make_detector(kGimpact);
  const Semantics& semantics = detector->semantics();
  EXPECT_THAT(semantics.levels, ElementsAre(Level::kBody, Level::kTriangle));
  EXPECT_THAT(semantics.questions,
              ElementsAre(Question::kTriangles, Question::kContacts, Question::kBody));
  EXPECT_EQ(semantics.precision, Precision::kSingle);
  EXPECT_EQ(semantics.depth, DepthKind::kConvexPair);
  EXPECT_TRUE(semantics.closed);
  EXPECT_FALSE(semantics.exact);
  EXPECT_FALSE(semantics.solid);
  EXPECT_THAT(semantics.means, ::testing::HasSubstr("prism"));
}

TEST(Gimpact, ScaleIsTheOptionOrTheScenes) {
  const World small({moved(unit_box_mesh(4), 0.01), moved(unit_box_mesh(2), 0.01)});
  EXPECT_EQ(prepared("bullet-gimpact:scale=3", small)->semantics().scale, 3.0);
  // The smallest triangles have |cross| = 0.0025^2: 32^2 times that is above 8 sqrt(1.19e-7).
  EXPECT_EQ(prepared(kGimpact, small)->semantics().scale, 32.0);
  EXPECT_EQ(adapters::automatic_bullet_scale(small.bodies), 32.0);
}

TEST(BulletScale, LeavesOutSliversAndTrianglesWithoutArea) {
  TriangleMesh mesh = unit_box_mesh(1);
  mesh.vertices.insert(mesh.vertices.end(), {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1e-7, 0)});
  mesh.triangles.push_back({8, 9, 9});
  mesh.triangles.push_back({8, 9, 10});
  EXPECT_EQ(adapters::automatic_bullet_scale(World({mesh}).bodies), 1.0);
  mesh.vertices[10].y() = 1e-5;  // no sliver any more
  EXPECT_EQ(adapters::automatic_bullet_scale(World({mesh}).bodies), 32.0);
}

TEST(BulletScale, IsAtLeast1AndAtMost2To20) {
  EXPECT_EQ(adapters::automatic_bullet_scale({}), 1.0);
  EXPECT_EQ(adapters::automatic_bullet_scale(World({moved(unit_box_mesh(1), 1e6)}).bodies), 1.0);
  EXPECT_EQ(adapters::automatic_bullet_scale(World({moved(unit_box_mesh(1), 1e-12)}).bodies),
            1048576.0);
  // The smaller body decides.
  EXPECT_EQ(adapters::automatic_bullet_scale(
                World({unit_box_mesh(1), moved(unit_box_mesh(1), 1.0 / 1024.0)}).bodies),
            64.0);
}

TEST(Gimpact, FindsAllCrossingPairsOfTwoSpheres) {
  const World world = two_gimpact_spheres();
  ASSERT_THAT(true_pairs(world), SizeIs(Gt(50u)));
  EXPECT_THAT(missed(world), IsEmpty());
  EXPECT_THAT(missed(world, "bullet-gimpact:scale=100"), IsEmpty());
}

TEST(Gimpact, SmallMeshesAreSeenAtTheAutomaticScale) {
  const World world({moved(two_gimpact_spheres().bodies[0].shape->mesh, 1e-4),
                     moved(two_gimpact_spheres().bodies[1].shape->mesh, 1e-4)});
  ASSERT_THAT(true_pairs(world), SizeIs(Gt(50u)));
  EXPECT_THAT(missed(world), IsEmpty());
}

TEST(Gimpact, TouchingBoxesAreInContact) {
  const TriangleMesh box = unit_box_mesh(2);
  for (const Vec3& side : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)})
    EXPECT_THAT(missed(World({box, moved(box, 1.0, side)})), IsEmpty()) << side.transpose();
}

TEST(Gimpact, SeparatedAndContainedBodiesAreNotInContact) {
  const TriangleMesh sphere = sphere_mesh(Vec3(0, 0, 0), 1, 3);
  for (const World& world : {World({sphere, moved(sphere, 1, Vec3(5, 0, 0))}),
                             World({sphere, moved(sphere, 1, Vec3(1.3, 1.3, 1.3))}),
                             World({sphere, moved(sphere, 0.5)})}) {
    EXPECT_THAT(gimpact_triangles(world), IsEmpty());
    EXPECT_THAT(ask(kGimpact, world, Question::kBody).bodies, IsEmpty());
  }
}

// What `means` says: back to back, each behind the other's plane, a third of a metre apart.
TEST(Gimpact, ReportsTrianglesThatLieBackToBackButNotFaceToFace) {
  const TriangleMesh below = triangle_mesh(Vec3(0, 0, 0), Vec3(0, 4, 0), Vec3(4, 0, 4));
  const TriangleMesh above =
      moved(triangle_mesh(Vec3(0, 0, 0), Vec3(4, 0, 4), Vec3(0, 4, 0)), 1.0, Vec3(-0.25, 0, 0.25));
  const World back_to_back({below, above});
  ASSERT_THAT(true_pairs(back_to_back), IsEmpty());
  EXPECT_THAT(gimpact_triangles(back_to_back), ElementsAre(ElementPair{0, 1, 0, 0}));
  EXPECT_THAT(gimpact_triangles(World({moved(below, 1.0, Vec3(-0.5, 0, 0.5)), above})), IsEmpty());
}

TEST(Gimpact, MarginReportsMore) {
  const World world = two_gimpact_spheres();
  const std::vector<ElementPair> without_margin = gimpact_triangles(world);
  const std::vector<ElementPair> with_margin =
      gimpact_triangles(world, "bullet-gimpact:margin=0.05");
  EXPECT_GT(with_margin.size(), without_margin.size() + 40);
  EXPECT_THAT(without(without_margin, with_margin), IsEmpty());
}

// Two parallel plates, 0.0625 apart: margins reach from each of them.
TEST(Gimpact, MarginIsInMetresAndCountsTwice) {
  const TriangleMesh plate = triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  TriangleMesh above = moved(plate, 1.0, Vec3(0, 0, 0.0625));
  std::swap(above.triangles[0][1], above.triangles[0][2]);  // face to face
  const World world({plate, above});
  for (const char* scale : {"1", "256"}) {
    const std::string tail = std::string(",scale=") + scale;
    EXPECT_THAT(gimpact_triangles(world, "bullet-gimpact:margin=0.03" + tail), IsEmpty());
    EXPECT_THAT(gimpact_triangles(world, "bullet-gimpact:margin=0.033" + tail), SizeIs(1));
    const ContactSet contacts =
        ask("bullet-gimpact:margin=0.033" + tail, world, Question::kContacts);
    EXPECT_THAT(contacts.triangles, SizeIs(1));
    EXPECT_THAT(contacts.piece_contacts, IsEmpty());  // apart: no depth
  }
}

TEST(Gimpact, ContactsHaveTheDepthAndTheWayOutOfTheSecondBody) {
  const World upright = spike_over_floor(-0.125);
  World swapped = upright;
  std::swap(swapped.bodies[0], swapped.bodies[1]);
  std::swap(swapped.vertices[0], swapped.vertices[1]);
  for (const char* name : {"bullet-gimpact", "bullet-gimpact:scale=64",
                           "bullet-gimpact:margin=0.25", "bullet-gimpact:margin=0.01,scale=8"}) {
    for (const bool is_swapped : {false, true}) {
      const ContactSet contacts = ask(name, is_swapped ? swapped : upright, Question::kContacts);
      EXPECT_THAT(contacts.triangles, ElementsAre(ElementPair{0, 1, 0, 0}));
      ASSERT_FALSE(contacts.piece_contacts.empty()) << name;
      for (const PieceContact& c : contacts.piece_contacts) {
        EXPECT_NEAR(c.depth, 0.125, 1e-6) << name;
        EXPECT_NEAR((c.normal - Vec3(0, 0, is_swapped ? -1 : 1)).norm(), 0.0, 1e-6) << name;
      }
    }
  }
}

TEST(Gimpact, ContactsAreThePairsOfTheOtherQuestionWithUnitNormals) {
  const World world = two_gimpact_spheres();
  const auto detector = prepared(kGimpact, world);
  const ContactSet contacts = ask(*detector, Question::kContacts);
  EXPECT_EQ(contacts.triangles, ask(*detector, Question::kTriangles).triangles);
  EXPECT_GE(contacts.piece_contacts.size(), contacts.triangles.size());
  for (const PieceContact& c : contacts.piece_contacts) {
    EXPECT_NEAR(c.normal.norm(), 1.0, 1e-12);
    EXPECT_GE(c.depth, 0.0);
    EXPECT_TRUE(std::binary_search(contacts.triangles.begin(), contacts.triangles.end(), c.pieces));
  }
}

TEST(Gimpact, IdsAreThoseOfTheInputAndSwapWithTheBodies) {
  const World world({unit_box_mesh(1), sphere_mesh(Vec3(1, 0.4, 0.6), 0.3, 3)});
  World swapped = world;
  std::swap(swapped.bodies[0], swapped.bodies[1]);
  std::swap(swapped.vertices[0], swapped.vertices[1]);
  std::vector<ElementPair> expected;
  for (const ElementPair& p : gimpact_triangles(world)) {
    EXPECT_LT(p.a, 12u);
    EXPECT_LT(p.b, 512u);
    expected.push_back({0, 1, p.b, p.a});
  }
  canonicalize(expected);
  EXPECT_THAT(expected, SizeIs(Gt(10u)));
  EXPECT_EQ(gimpact_triangles(swapped), expected);
}

TEST(Gimpact, QuestionsAgreeOnManyBodies) {
  World world({8, sphere_mesh(Vec3(0, 0, 0), 0.5, 2)});
  for (std::uint32_t b = 0; b < 8; ++b)
    for (Vec3& v : world.vertices[b]) v += 0.9 * Vec3(b % 2, b / 2 % 2, b / 4);
  const auto detector = prepared(kGimpact, world);
  const ContactSet pairs = ask(*detector, Question::kTriangles);
  EXPECT_THAT(pairs.bodies, SizeIs(12u));  // the edges of a cube
  ContactSet out;
  out.bodies.push_back({7, 8});
  detector->query(Question::kBody, out);
  EXPECT_EQ(std::vector<BodyPair>(out.bodies.begin() + 1, out.bodies.end()), pairs.bodies);
  EXPECT_THAT(out.triangles, IsEmpty());
}

// Bullet's own refit loses every contact of a body that has moved more than one unit from where it
// was built; on the wider grid that the adapter builds, boxes must not lose what they hold.
TEST(Gimpact, BodiesThatMoveFarKeepTheirContacts) {
  World world({sphere_mesh(Vec3(0, 0, 0), 1, 4), sphere_mesh(Vec3(1.1, 0.3, 0.2), 0.9, 4)});
  const World start = world;
  for (const double offset : {0.0, 2.5, 300.0}) {
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t v = 0; v < start.vertices[b].size(); ++v)
        world.vertices[b][v] = start.vertices[b][v] + Vec3(offset, 0, -offset);
    const std::vector<ElementPair> truth = true_pairs(fed(world, 1.0));
    ASSERT_THAT(truth, SizeIs(Gt(100u)));
    const std::vector<ElementPair> got = gimpact_triangles(world, "bullet-gimpact:scale=1");
    EXPECT_THAT(without(truth, got), IsEmpty()) << offset;
    EXPECT_THAT(without(got, truth), SizeIs(::testing::Lt(10u))) << offset;
  }
}

/// Processor time of this thread that one query takes, which must find some pairs.
double seconds_of_query(const World& world) {
  const auto detector = prepared("bullet-gimpact:scale=1", world);
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  const ContactSet got = ask(*detector, Question::kTriangles);
  const double seconds = now() - start;
  EXPECT_THAT(got.triangles, SizeIs(Gt(100u)));
  return seconds;
}

// On a grid as wide as the way, all boxes of a body are one: the query tests every pair.
TEST(Gimpact, BodiesVeryFarAwayAreStillToldApartByTheirTrees) {
  World world({sphere_mesh(Vec3(0, 0, 0), 1, 5), sphere_mesh(Vec3(1.1, 0.3, 0.2), 0.9, 5)});
  const double near = seconds_of_query(world);
  for (std::vector<Vec3>& body : world.vertices)
    for (Vec3& v : body) v += Vec3(0x1p18, 0x1p17, -0x1p18);
  EXPECT_LT(seconds_of_query(world), 20.0 * near + 0.05);
}

TEST(Gimpact, EarlierFramesLeaveNoTrace) {
  const World start = two_gimpact_spheres();
  World world = start;
  const auto detector = prepared(kGimpact, start);
  const ContactSet before = ask(*detector, Question::kContacts);
  ASSERT_FALSE(before.triangles.empty());
  for (const double offset : {0.5, 3.5, -3.5, 1000.0, -1000.0, 3e5, 20.0, 0.25}) {
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t v = 0; v < start.vertices[b].size(); ++v)
        world.vertices[b][v] = start.vertices[b][v] + Vec3(0, offset, 0);
    detector->update(world.frame());
    const ContactSet there = ask(*detector, Question::kTriangles);
    EXPECT_THAT(there.triangles, SizeIs(Gt(50u))) << offset;
    EXPECT_EQ(there.triangles, gimpact_triangles(world)) << offset;
  }
  for (int again = 0; again < 2; ++again) {
    detector->update(start.frame());
    const ContactSet after = ask(*detector, Question::kContacts);
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(after.piece_contacts.size(), before.piece_contacts.size());
  }
}

TEST(Gimpact, PrepareAgainForgetsTheFirstScene) {
  const World first({unit_box_mesh(2), unit_box_mesh(2), unit_box_mesh(3)});
  const World second = two_gimpact_spheres();
  const auto detector = prepared(kGimpact, first);
  detector->prepare(second.bodies);
  detector->update(second.frame());
  EXPECT_EQ(ask(*detector, Question::kTriangles).triangles, gimpact_triangles(second));
}

TEST(Gimpact, DegenerateTrianglesAreNotSeenAndNoted) {
  const TriangleMesh plate = triangle_mesh(Vec3(-1, -1, 0), Vec3(3, -1, 0), Vec3(-1, 3, 0));
  const TriangleMesh segment = triangle_mesh(Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(0, 0, 0.5));
  const auto detector = prepared(kGimpact, World({plate, segment}));
  EXPECT_THAT(ask(*detector, Question::kTriangles).triangles, IsEmpty());
  EXPECT_THAT(detector->notes(), ElementsAre(::testing::HasSubstr("without area")));
  EXPECT_THAT(prepared(kGimpact, two_gimpact_spheres())->notes(), IsEmpty());
}

TEST(Gimpact, ValuesThatAreNotFiniteAsFloatsAreRefused) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e39}) {
    World world = two_gimpact_spheres();
    const auto detector = prepared(kGimpact, world);
    world.vertices[1][7].y() = bad;
    EXPECT_THROW(detector->update(world.frame()), RefusedInput) << bad;
  }
  EXPECT_THROW(prepared("bullet-gimpact:scale=1", World({moved(unit_box_mesh(1), 1e39)})),
               RefusedInput);
}

TEST(Gimpact, SingleTrianglesAndSingleBodiesAreAnswered) {
  EXPECT_THAT(gimpact_triangles(spike_over_floor(-0.125)), SizeIs(1));
  EXPECT_THAT(gimpact_triangles(spike_over_floor(0.125)), IsEmpty());
  EXPECT_THAT(gimpact_triangles(World({unit_box_mesh(1)})), IsEmpty());
  EXPECT_THAT(gimpact_triangles(World({})), IsEmpty());
}

TEST(Gimpact, DetectorsOnTwoThreadsAnswerAsAlone) {
  const World first = two_gimpact_spheres();
  World second = two_gimpact_spheres();
  for (Vec3& v : second.vertices[1]) v += Vec3(0.2, -0.1, 0.3);
  const auto expected_first = gimpact_triangles(first), expected_second = gimpact_triangles(second);
  ASSERT_NE(expected_first, expected_second);
  const auto run = [](const World& world, const std::vector<ElementPair>& expected, int& wrong) {
    for (int round = 0; round < 20; ++round) wrong += gimpact_triangles(world) != expected;
  };
  int wrong_first = 0, wrong_second = 0;
  std::thread other([&] { run(second, expected_second, wrong_second); });
  run(first, expected_first, wrong_first);
  other.join();
  EXPECT_EQ(wrong_first, 0);
  EXPECT_EQ(wrong_second, 0);
}

}  // namespace
}  // namespace contactcheck::test
