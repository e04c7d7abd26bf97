#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/core/recording/allocation_watch.h"
#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

TriangleMesh twelve_triangles(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back(c & 1 ? hi.x() : lo.x(), c & 2 ? hi.y() : lo.y(),
                               c & 4 ? hi.z() : lo.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh ball(const Vec3& center, double radius, std::uint32_t rings = 12) {
  return moved(grid_sphere(radius, rings), 1.0, center);
}

class FclDetectors : public ::testing::TestWithParam<const char*> {
 protected:
  static std::unique_ptr<Detector> prepared(const World& world) {
    return test::prepared(GetParam(), world);
  }
  static std::vector<ElementPair> triangles(const World& world) {
    return ask(*prepared(world), Question::kTriangles).triangles;
  }
};

INSTANTIATE_TEST_SUITE_P(All, FclDetectors,
                         ::testing::Values("fcl-aabb", "fcl-obbrss", "fcl-collide"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(FclDetectors, ClaimClosedSurfacesInDoubleWithoutExactness) {
  const Semantics semantics = make_detector(GetParam())->semantics();
  std::vector<Level> levels = {Level::kBody, Level::kTriangle};
  std::vector<Question> questions = {Question::kTriangles, Question::kBody, Question::kContacts};
  if (GetParam() != std::string("fcl-collide")) {
    levels.push_back(Level::kSelf);
    questions.push_back(Question::kSelf);
  }
  EXPECT_EQ(semantics.levels, levels);
  EXPECT_EQ(semantics.questions, questions);
  EXPECT_EQ(semantics.depth, DepthKind::kConvexPair);
  EXPECT_TRUE(semantics.closed);
  EXPECT_FALSE(semantics.solid);
  EXPECT_FALSE(semantics.exact);
  EXPECT_EQ(semantics.precision, Precision::kDouble);
  EXPECT_TRUE(make_detector(GetParam())->needs_vertices());
}

TEST_P(FclDetectors, OverlappingBoxesGiveExactlyTheTruePairs) {
  const World world({twelve_triangles(Vec3(0, 0, 0), Vec3(2, 2, 2)),
                     twelve_triangles(Vec3(1, 0.5, 0.75), Vec3(3, 1.25, 1.5))});
  const std::vector<ElementPair> truth = true_pairs(world);
  ASSERT_THAT(truth, SizeIs(::testing::Gt(5u)));
  EXPECT_EQ(compare(world, triangles(world)), "");
}

/// As FCL names them, before a caller sorts them.
std::vector<ElementPair> found_in_order(Detector& detector, const World& world) {
  detector.update(world.frame());
  ContactSet set;
  detector.query(Question::kTriangles, set);
  return set.triangles;
}

TEST_P(FclDetectors, EverySettingFindsTheTruePairsOfBodiesThatMoveAndStretch) {
  World world({ball(Vec3(0, 0, 0), 1.0), ball(Vec3(1.1, 0.3, 0.2), 0.9)});
  std::vector<std::unique_ptr<Detector>> detectors;
  for (const std::string refit : {"bottom-up", "top-down", "rebuild"})
    for (const std::string split : {"mean", "median", "center"})
      detectors.push_back(
          test::prepared(std::string(GetParam()) + ":refit=" + refit + ",split=" + split, world));
  stretch(world, 0);
  for (const auto& detector : detectors) {
    std::vector<ElementPair> found = found_in_order(*detector, world);
    canonicalize(found);
    EXPECT_EQ(compare(world, found), "");
  }
  // A hierarchy of the rest shape is gone through in another order than one of this frame, and so
  // are two that were divided at other places.
  const std::vector<ElementPair> refitted = found_in_order(*detectors[0], world);
  EXPECT_NE(found_in_order(*detectors[6], world), refitted);  // rebuild
  EXPECT_NE(found_in_order(*detectors[1], world), refitted);  // median
  EXPECT_NE(found_in_order(*detectors[2], world), refitted);  // center
}

// Copies cost a twentieth of the time, which no rule on times would find.
TEST_P(FclDetectors, ModelsAreCopiedWhereTheDocumentedCallDoesSo) {
  const TriangleMesh mesh = ball(Vec3::Zero(), 1.0, 60);
  const World world({mesh, moved(mesh, 1.0, Vec3(1.99, 0, 0))});
  const auto detector = prepared(world);
  ContactSet set;
  detector->query(Question::kTriangles, set);  // whose capacities are kept
  EXPECT_THAT(set.triangles, Not(IsEmpty()));
  set.clear();
  reset_largest_allocation();
  detector->query(Question::kTriangles, set);
  const std::size_t vertices = mesh.vertices.size() * sizeof(Vec3);
  if (GetParam() == std::string("fcl-collide"))
    EXPECT_GE(largest_allocation(), vertices);
  else
    EXPECT_LT(largest_allocation(), vertices / 4);
}

TEST_P(FclDetectors, TouchingBoxesAreInContact) {
  const World world({twelve_triangles(Vec3(0, 0, 0), Vec3(1, 1, 1)),
                     twelve_triangles(Vec3(1, 0.25, 0.25), Vec3(2, 0.75, 0.75))});
  EXPECT_EQ(compare(world, triangles(world)), "");
  EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
}

TEST_P(FclDetectors, BoxesThatTouchInOneCornerAreInContact) {
  const World world({twelve_triangles(Vec3(0, 0, 0), Vec3(1, 1, 1)),
                     twelve_triangles(Vec3(1, 1, 1), Vec3(2, 2, 2))});
  EXPECT_EQ(compare(world, triangles(world)), "");
  EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
}

TEST_P(FclDetectors, SeparatedBodiesAreNot) {
  // The boxes of the second pair of bodies meet, their surfaces do not.
  for (const Vec3& center : {Vec3(5, 0, 0), Vec3(1.3, 1.3, 1.3)}) {
    const World world({ball(Vec3(0, 0, 0), 1), ball(center, 1)});
    EXPECT_THAT(triangles(world), IsEmpty());
    EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, IsEmpty());
  }
}

TEST_P(FclDetectors, ContainedBodyIsNoContact) {
  const World world({ball(Vec3(0, 0, 0), 2), ball(Vec3(0.1, 0.2, 0.3), 0.5)});
  EXPECT_THAT(triangles(world), IsEmpty());
  EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, IsEmpty());
}

TEST_P(FclDetectors, OverlappingSpheresGiveExactlyTheTruePairs) {
  const World world({ball(Vec3(0, 0, 0), 1), ball(Vec3(1.1, 0.3, 0.2), 0.9)});
  const std::vector<ElementPair> truth = true_pairs(world);
  ASSERT_THAT(truth, SizeIs(::testing::Gt(50u)));
  EXPECT_EQ(compare(world, triangles(world)), "");
}

// FCL stops at the number of contacts that a request allows.
TEST_P(FclDetectors, ReportAllContactsOfAPairHoweverMany) {
  constexpr std::uint32_t kTriangles = 70;
  // Triangles across the x axis, and across the y axis: each of the first crosses each of the
  // second, well within both.
  TriangleMesh across_x, across_y;
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    const double at = i;
    for (const Vec3& p : {Vec3(at, -200, -200), Vec3(at, 300, -200), Vec3(at, 37, 300)})
      across_x.vertices.push_back(p);
    for (const Vec3& p : {Vec3(-200, at, 300), Vec3(300, at, 300), Vec3(31, at, -200)})
      across_y.vertices.push_back(p);
    across_x.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    across_y.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const World world({across_x, across_y});
  const auto detector = prepared(world);
  EXPECT_THAT(ask(*detector, Question::kTriangles).triangles, SizeIs(kTriangles * kTriangles));
  EXPECT_THAT(ask(*detector, Question::kContacts).triangles, SizeIs(kTriangles * kTriangles));
}

TEST_P(FclDetectors, IdsAreThoseOfTheInput) {
  // A needle through triangle 2 of three stacked ones, in the second triangle of its mesh.
  TriangleMesh stack;
  for (int i = 0; i < 3; ++i) {
    const auto first = static_cast<std::uint32_t>(stack.vertices.size());
    for (const Vec3& p : {Vec3(-1, -1, i), Vec3(1, -1, i), Vec3(0, 1, i)})
      stack.vertices.push_back(p);
    stack.triangles.push_back({first, first + 1, first + 2});
  }
  const TriangleMesh needle = {{Vec3(0, 0, 1.5), Vec3(0, 0, 2.5), Vec3(0.1, 0, 2.5), Vec3(9, 9, 9),
                                Vec3(9, 9, 8), Vec3(9, 8, 9)},
                               {{3, 4, 5}, {0, 1, 2}}};
  EXPECT_THAT(triangles(World({stack, needle})), ElementsAre(ElementPair{0, 1, 2, 1}));
  EXPECT_THAT(triangles(World({needle, stack})), ElementsAre(ElementPair{0, 1, 1, 2}));
}

TEST_P(FclDetectors, UpdatesGiveTheAnswersOfAFreshDetector) {
  World world({ball(Vec3(0, 0, 0), 1), ball(Vec3(3, 0.07, 0.03), 0.95)});
  const std::unique_ptr<Detector> updated = prepared(world);
  std::size_t in_contact = 0;
  for (int step = 0; step < 12; ++step) {
    for (Vec3& v : world.vertices[1])
      v += Vec3(-0.3, 0.02 * v.y() * v.y(), 0.05 * std::sin(step + 3.0 * v.x()));
    updated->update(world.frame());
    const ContactSet got = ask(*updated, Question::kTriangles);
    EXPECT_EQ(got.triangles, triangles(world)) << step;
    EXPECT_EQ(compare(world, got.triangles), "") << step;
    in_contact += got.triangles.empty() ? 0 : 1;
  }
  EXPECT_GT(in_contact, 3u);
  EXPECT_LT(in_contact, 12u);
}

TEST_P(FclDetectors, EarlierFramesLeaveNoTrace) {
  World world({ball(Vec3(0, 0, 0), 1), ball(Vec3(1.5, 0.1, 0), 1)});
  const World start = world;
  const std::unique_ptr<Detector> detector = prepared(start);
  const ContactSet before = ask(*detector, Question::kTriangles);
  ASSERT_FALSE(before.triangles.empty());
  for (Vec3& v : world.vertices[1]) v = 10.0 * v;
  detector->update(world.frame());
  detector->update(start.frame());
  EXPECT_EQ(ask(*detector, Question::kTriangles).triangles, before.triangles);
}

TEST_P(FclDetectors, PrepareAgainForgetsTheFirstScene) {
  const World first({twelve_triangles(Vec3(0, 0, 0), Vec3(1, 1, 1)),
                     twelve_triangles(Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2)),
                     twelve_triangles(Vec3(0.25, 0.25, 0.25), Vec3(2, 2, 2))});
  const World second({ball(Vec3(0, 0, 0), 1), ball(Vec3(1.5, 0.07, 0.03), 0.95)});
  const std::unique_ptr<Detector> detector = prepared(first);
  detector->prepare(second.bodies);
  detector->update(second.frame());
  EXPECT_EQ(compare(second, ask(*detector, Question::kTriangles).triangles), "");
}

TEST_P(FclDetectors, RepeatedQueriesGiveTheSameAnswer) {
  const World world({ball(Vec3(0, 0, 0), 1), ball(Vec3(1.5, 0.07, 0.03), 0.95)});
  const std::unique_ptr<Detector> detector = prepared(world);
  const ContactSet first = ask(*detector, Question::kTriangles);
  ask(*detector, Question::kBody);
  EXPECT_EQ(ask(*detector, Question::kTriangles).triangles, first.triangles);
  EXPECT_FALSE(first.triangles.empty());
}

TEST_P(FclDetectors, BothQuestionsAgreeOnManyBodies) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0.0, 4.0);
  std::vector<TriangleMesh> meshes;
  for (int i = 0; i < 24; ++i) {
    const Vec3 center(coordinate(random), coordinate(random), coordinate(random));
    meshes.push_back(ball(center, 0.5, 6));
  }
  const World world(meshes);
  const std::unique_ptr<Detector> detector = prepared(world);
  const ContactSet pairs = ask(*detector, Question::kTriangles);
  const ContactSet bodies = ask(*detector, Question::kBody);
  EXPECT_EQ(compare(world, pairs.triangles), "");
  EXPECT_EQ(bodies.bodies, pairs.bodies);
  EXPECT_THAT(bodies.triangles, IsEmpty());
  EXPECT_THAT(bodies.bodies, SizeIs(::testing::AllOf(::testing::Gt(5u), ::testing::Lt(200u))));
}

TEST_P(FclDetectors, QueryAppendsToWhatIsThere) {
  const World world({twelve_triangles(Vec3(0, 0, 0), Vec3(1, 1, 1)),
                     twelve_triangles(Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2))});
  ContactSet out;
  out.bodies.push_back({7, 8});
  prepared(world)->query(Question::kBody, out);
  EXPECT_THAT(out.bodies, ElementsAre(BodyPair{7, 8}, BodyPair{0, 1}));
}

TEST_P(FclDetectors, OneBodyHasNoContact) {
  const World world({twelve_triangles(Vec3(0, 0, 0), Vec3(1, 1, 1))});
  EXPECT_THAT(triangles(world), IsEmpty());
}

// A triangle that hangs 0.125 deep through a large one: the shortest way out is up.
TEST_P(FclDetectors, ContactsHaveTheDepthAndTheWayOutOfTheSecondBody) {
  const TriangleMesh floor = {{Vec3(-8, -8, 0), Vec3(8, -8, 0), Vec3(0, 8, 0)}, {{0, 1, 2}}};
  const TriangleMesh spike = {{Vec3(0, 0, -0.125), Vec3(1, 0, 0.875), Vec3(-1, 0, 0.875)},
                              {{0, 1, 2}}};
  for (const bool swapped : {false, true}) {
    const World world(swapped ? std::vector{spike, floor} : std::vector{floor, spike});
    const ContactSet contacts = ask(*prepared(world), Question::kContacts);
    EXPECT_THAT(contacts.triangles, ElementsAre(ElementPair{0, 1, 0, 0}));
    ASSERT_FALSE(contacts.piece_contacts.empty());
    for (const PieceContact& c : contacts.piece_contacts) {
      EXPECT_NEAR(c.depth, 0.125, 1e-12);
      const Vec3 up(0, 0, swapped ? -1 : 1);  // the floor goes down instead
      EXPECT_NEAR((c.normal - up).norm(), 0.0, 1e-12);
    }
  }
}

TEST_P(FclDetectors, ContactsAreThePairsOfTheOtherQuestionWithUnitNormals) {
  const World world({ball(Vec3(0, 0, 0), 1), ball(Vec3(1.3, 0.2, 0.1), 1)});
  const auto detector = prepared(world);
  const ContactSet contacts = ask(*detector, Question::kContacts);
  EXPECT_EQ(contacts.triangles, ask(*detector, Question::kTriangles).triangles);
  EXPECT_GE(contacts.piece_contacts.size(), contacts.triangles.size());
  for (const PieceContact& c : contacts.piece_contacts) {
    EXPECT_NEAR(c.normal.norm(), 1.0, 1e-9);
    EXPECT_TRUE(std::binary_search(contacts.triangles.begin(), contacts.triangles.end(), c.pieces));
  }
}

// A segment and a point written as triangles that lie on the other surface, beside a degenerate
// triangle far away: all are real contacts but the last.
TEST_P(FclDetectors, DegenerateTrianglesOnASurfaceAreFound) {
  const TriangleMesh plate = {{Vec3(-1, -1, 0), Vec3(3, -1, 0), Vec3(-1, 3, 0)}, {{0, 1, 2}}};
  const TriangleMesh degenerate = {
      {Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(0, 0, 0.5), Vec3(0.25, 0.25, 0), Vec3(0.25, 0.25, 0),
       Vec3(0.25, 0.25, 0), Vec3(50, 50, 50), Vec3(51, 51, 51), Vec3(52, 52, 52)},
      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
  const World world({plate, degenerate});
  EXPECT_THAT(triangles(world), ElementsAre(ElementPair{0, 1, 0, 0}, ElementPair{0, 1, 0, 1}));
}

// FCL gives it the normal of an earlier triangle, or whatever else was in memory: Intersect's
// intersect_Triangle() leaves the normal unwritten and goes on with it. With contacts asked, even
// whether such a pair is reported hangs on that.
TEST_P(FclDetectors, TriangleWithoutAreaHasNoDepth) {
  const TriangleMesh floor = {{Vec3(-8, -8, 0), Vec3(8, -8, 0), Vec3(0, 8, 0)}, {{0, 1, 2}}};
  const TriangleMesh spikes = {
      {Vec3(0, 0, -0.125), Vec3(1, 0, 0.875), Vec3(-1, 0, 0.875), Vec3(0, 0, -1), Vec3(0, 0, 1),
       Vec3(0, 0, 0.5), Vec3(0.25, 0.25, 0), Vec3(0.25, 0.25, 0), Vec3(0.25, 0.25, 0)},
      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
  for (const bool swapped : {false, true}) {
    const ContactSet contacts =
        ask(*prepared(World(swapped ? std::vector{spikes, floor} : std::vector{floor, spikes})),
            Question::kContacts);
    EXPECT_THAT(contacts.triangles, Contains(ElementPair{0, 1, 0, 0}));
    EXPECT_THAT(contacts.piece_contacts, Not(IsEmpty()));
    for (const PieceContact& c : contacts.piece_contacts)
      EXPECT_EQ(c.pieces, (ElementPair{0, 1, 0, 0}));
  }
}

TEST_P(FclDetectors, BodyFlattenedToAPointIsAnswered) {
  const TriangleMesh box = twelve_triangles(Vec3(0, 0, 0), Vec3(1, 1, 1));
  World world({box, box});
  const std::unique_ptr<Detector> detector = prepared(world);
  for (Vec3& v : world.vertices[1]) v = Vec3(5, 5, 5);
  detector->update(world.frame());
  EXPECT_THAT(ask(*detector, Question::kTriangles).bodies, IsEmpty());
  for (Vec3& v : world.vertices[1]) v = Vec3(0.5, 0.25, 1.0);
  detector->update(world.frame());
  EXPECT_THAT(ask(*detector, Question::kTriangles).bodies, SizeIs(1));
}

TEST_P(FclDetectors, CoincidentMeshesReportEveryTriangleWithItself) {
  const TriangleMesh sphere = ball(Vec3(0, 0, 0), 1, 6);
  const std::vector<ElementPair> pairs = triangles(World({sphere, sphere}));
  std::size_t missing = 0;
  for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t)
    missing += std::find(pairs.begin(), pairs.end(), ElementPair{0, 1, t, t}) == pairs.end();
  // Oriented boxes are known to lose pairs of coincident meshes by rounding (FCL 0.7.0).
  EXPECT_LE(missing, std::string(GetParam()) == "fcl-obbrss" ? sphere.triangles.size() / 10 : 0u);
}

}  // namespace
}  // namespace contactcheck::test
