#include "reference/adapters/fcl_adapter.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <sstream>

#include "core/narrow/triangle_triangle.h"
#include "reference/adapters/register.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back(c & 1 ? hi.x() : lo.x(), c & 2 ? hi.y() : lo.y(),
                               c & 4 ? hi.z() : lo.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// A sphere without degenerate triangles: vertex 0 and the last are the poles.
TriangleMesh sphere_mesh(const Vec3& center, double radius, std::uint32_t rings = 12) {
  const std::uint32_t segments = 2 * rings, last = (rings - 1) * segments + 1;
  TriangleMesh mesh;
  mesh.vertices.push_back(center + Vec3(0, 0, radius));
  for (std::uint32_t r = 1; r < rings; ++r) {
    for (std::uint32_t s = 0; s < segments; ++s) {
      const double polar = M_PI * r / rings, around = 2.0 * M_PI * s / segments;
      mesh.vertices.push_back(center + radius * Vec3(std::sin(polar) * std::cos(around),
                                                     std::sin(polar) * std::sin(around),
                                                     std::cos(polar)));
    }
  }
  mesh.vertices.push_back(center - Vec3(0, 0, radius));
  const auto ring = [&](std::uint32_t r, std::uint32_t s) {
    return 1 + r * segments + s % segments;
  };
  for (std::uint32_t s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0, ring(0, s), ring(0, s + 1)});
    for (std::uint32_t r = 0; r + 2 < rings; ++r) {
      mesh.triangles.push_back({ring(r, s), ring(r + 1, s), ring(r + 1, s + 1)});
      mesh.triangles.push_back({ring(r, s), ring(r + 1, s + 1), ring(r, s + 1)});
    }
    mesh.triangles.push_back({ring(rings - 2, s), last, ring(rings - 2, s + 1)});
  }
  return mesh;
}

/// Bodies without lattices and the frame they are in; a test moves `vertices`.
struct World {
  explicit World(const std::vector<TriangleMesh>& meshes) {
    for (const TriangleMesh& mesh : meshes) {
      bodies.push_back({"body " + std::to_string(bodies.size()), make_bare_shape(mesh)});
      vertices.push_back(mesh.vertices);
    }
  }
  Frame frame() const {
    Frame out;
    for (const std::vector<Vec3>& v : vertices) out.bodies.push_back({v, v});
    return out;
  }
  TrianglePoints points(std::size_t body, std::size_t triangle) const {
    const Triangle& t = bodies[body].shape->mesh.triangles[triangle];
    return {vertices[body][t[0]], vertices[body][t[1]], vertices[body][t[2]]};
  }

  std::vector<Body> bodies;
  std::vector<std::vector<Vec3>> vertices;
};

/// All pairs, every triangle against every other, by core's exact test.
std::vector<ElementPair> true_pairs(const World& world) {
  std::vector<ElementPair> out;
  for (std::uint32_t a = 0; a < world.bodies.size(); ++a)
    for (std::uint32_t b = a + 1; b < world.bodies.size(); ++b)
      for (std::uint32_t i = 0; i < world.bodies[a].shape->mesh.triangles.size(); ++i)
        for (std::uint32_t j = 0; j < world.bodies[b].shape->mesh.triangles.size(); ++j)
          if (triangles_intersect(world.points(a, i), world.points(b, j)))
            out.push_back({a, b, i, j});
  return out;
}

/// Pairs in one set but not in the other, with exact coordinates: ids alone are no diagnosis.
std::string differences(const World& world, const std::vector<ElementPair>& got,
                        const std::vector<ElementPair>& truth) {
  std::vector<ElementPair> off;
  std::set_symmetric_difference(got.begin(), got.end(), truth.begin(), truth.end(),
                                std::back_inserter(off));
  std::ostringstream out;
  out << off.size() << " pairs differ" << std::hexfloat;
  for (std::size_t i = 0; i < std::min<std::size_t>(off.size(), 2); ++i) {
    const ElementPair& p = off[i];
    const bool missed = std::binary_search(truth.begin(), truth.end(), p);
    out << "\n"
        << (missed ? "missed " : "spurious ") << p.body_a << ":" << p.a << " " << p.body_b << ":"
        << p.b;
    for (const Vec3& v : world.points(p.body_a, p.a)) out << "\n  " << v.transpose();
    for (const Vec3& v : world.points(p.body_b, p.b)) out << "\n  " << v.transpose();
  }
  return out.str();
}

/// "" when the sets are equal.
std::string compare(const World& world, const std::vector<ElementPair>& got) {
  const std::vector<ElementPair> truth = true_pairs(world);
  return got == truth ? "" : differences(world, got, truth);
}

ContactSet ask(Detector& detector, Question question) {
  ContactSet out;
  detector.query(question, out);
  out.canonicalize();
  return out;
}

class FclDetectors : public ::testing::TestWithParam<const char*> {
 protected:
  static std::unique_ptr<Detector> make() {
    DetectorCatalog catalog;
    register_reference_detectors(catalog);
    return catalog.make(catalog.parse(GetParam()));
  }
  static std::unique_ptr<Detector> prepared(const World& world) {
    std::unique_ptr<Detector> detector = make();
    detector->prepare(world.bodies);
    detector->update(world.frame());
    return detector;
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
  const Semantics semantics = make()->semantics();
  EXPECT_THAT(semantics.levels, ElementsAre(Level::kBody, Level::kTriangle));
  EXPECT_THAT(semantics.questions,
              ElementsAre(Question::kTriangles, Question::kBody, Question::kContacts));
  EXPECT_EQ(semantics.depth, DepthKind::kConvexPair);
  EXPECT_TRUE(semantics.closed);
  EXPECT_FALSE(semantics.solid);
  EXPECT_FALSE(semantics.exact);
  EXPECT_EQ(semantics.precision, Precision::kDouble);
  EXPECT_TRUE(make()->needs_vertices());
}

TEST_P(FclDetectors, OverlappingBoxesGiveExactlyTheTruePairs) {
  const World world(
      {box_mesh(Vec3(0, 0, 0), Vec3(2, 2, 2)), box_mesh(Vec3(1, 0.5, 0.75), Vec3(3, 1.25, 1.5))});
  const std::vector<ElementPair> truth = true_pairs(world);
  ASSERT_THAT(truth, SizeIs(::testing::Gt(5u)));
  EXPECT_EQ(compare(world, triangles(world)), "");
}

TEST_P(FclDetectors, TouchingBoxesAreInContact) {
  const World world(
      {box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1)), box_mesh(Vec3(1, 0.25, 0.25), Vec3(2, 0.75, 0.75))});
  EXPECT_EQ(compare(world, triangles(world)), "");
  EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
}

TEST_P(FclDetectors, BoxesThatTouchInOneCornerAreInContact) {
  const World world(
      {box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1)), box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2))});
  EXPECT_EQ(compare(world, triangles(world)), "");
  EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
}

TEST_P(FclDetectors, SeparatedBodiesAreNot) {
  // The boxes of the second pair of bodies meet, their surfaces do not.
  for (const Vec3& center : {Vec3(5, 0, 0), Vec3(1.3, 1.3, 1.3)}) {
    const World world({sphere_mesh(Vec3(0, 0, 0), 1), sphere_mesh(center, 1)});
    EXPECT_THAT(triangles(world), IsEmpty());
    EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, IsEmpty());
  }
}

TEST_P(FclDetectors, ContainedBodyIsNoContact) {
  const World world({sphere_mesh(Vec3(0, 0, 0), 2), sphere_mesh(Vec3(0.1, 0.2, 0.3), 0.5)});
  EXPECT_THAT(triangles(world), IsEmpty());
  EXPECT_THAT(ask(*prepared(world), Question::kBody).bodies, IsEmpty());
}

TEST_P(FclDetectors, OverlappingSpheresGiveExactlyTheTruePairs) {
  const World world({sphere_mesh(Vec3(0, 0, 0), 1), sphere_mesh(Vec3(1.1, 0.3, 0.2), 0.9)});
  const std::vector<ElementPair> truth = true_pairs(world);
  ASSERT_THAT(truth, SizeIs(::testing::Gt(50u)));
  EXPECT_EQ(compare(world, triangles(world)), "");
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
  World world({sphere_mesh(Vec3(0, 0, 0), 1), sphere_mesh(Vec3(3, 0.07, 0.03), 0.95)});
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
  World world({sphere_mesh(Vec3(0, 0, 0), 1), sphere_mesh(Vec3(1.5, 0.1, 0), 1)});
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
  const World first({box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1)),
                     box_mesh(Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2)),
                     box_mesh(Vec3(0.25, 0.25, 0.25), Vec3(2, 2, 2))});
  const World second({sphere_mesh(Vec3(0, 0, 0), 1), sphere_mesh(Vec3(1.5, 0.07, 0.03), 0.95)});
  const std::unique_ptr<Detector> detector = prepared(first);
  detector->prepare(second.bodies);
  detector->update(second.frame());
  EXPECT_EQ(compare(second, ask(*detector, Question::kTriangles).triangles), "");
}

TEST_P(FclDetectors, RepeatedQueriesGiveTheSameAnswer) {
  const World world({sphere_mesh(Vec3(0, 0, 0), 1), sphere_mesh(Vec3(1.5, 0.07, 0.03), 0.95)});
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
    meshes.push_back(sphere_mesh(center, 0.5, 6));
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
  const World world(
      {box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1)), box_mesh(Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2))});
  ContactSet out;
  out.bodies.push_back({7, 8});
  prepared(world)->query(Question::kBody, out);
  EXPECT_THAT(out.bodies, ElementsAre(BodyPair{7, 8}, BodyPair{0, 1}));
}

TEST_P(FclDetectors, OneBodyHasNoContact) {
  const World world({box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1))});
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
  const World world({sphere_mesh(Vec3(0, 0, 0), 1), sphere_mesh(Vec3(1.3, 0.2, 0.1), 1)});
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

// FCL gives it the normal of an earlier triangle, or whatever else was in memory.
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
    EXPECT_THAT(contacts.triangles, SizeIs(3));
    EXPECT_THAT(contacts.piece_contacts, Not(IsEmpty()));
    for (const PieceContact& c : contacts.piece_contacts)
      EXPECT_EQ(c.pieces, (ElementPair{0, 1, 0, 0}));
  }
}

TEST_P(FclDetectors, BodyFlattenedToAPointIsAnswered) {
  const TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1));
  World world({box, box});
  const std::unique_ptr<Detector> detector = prepared(world);
  for (Vec3& v : world.vertices[1]) v = Vec3(5, 5, 5);
  detector->update(world.frame());
  EXPECT_THAT(ask(*detector, Question::kTriangles).bodies, IsEmpty());
  for (Vec3& v : world.vertices[1]) v = Vec3(0.5, 0.25, 1.0);
  detector->update(world.frame());
  // FCL 0.7.0 fits no usable oriented box to a point: fcl-obbrss loses this contact. The adapter
  // passes that on; a change of FCL should be noticed here.
  const std::size_t expected = std::string(GetParam()) == "fcl-obbrss" ? 0 : 1;
  EXPECT_THAT(ask(*detector, Question::kTriangles).bodies, SizeIs(expected));
}

TEST_P(FclDetectors, CoincidentMeshesReportEveryTriangleWithItself) {
  const TriangleMesh sphere = sphere_mesh(Vec3(0, 0, 0), 1, 6);
  const std::vector<ElementPair> pairs = triangles(World({sphere, sphere}));
  std::size_t missing = 0;
  for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t)
    missing += std::find(pairs.begin(), pairs.end(), ElementPair{0, 1, t, t}) == pairs.end();
  // Oriented boxes are known to lose pairs of coincident meshes by rounding (FCL 0.7.0).
  EXPECT_LE(missing, std::string(GetParam()) == "fcl-obbrss" ? sphere.triangles.size() / 10 : 0u);
}

}  // namespace
}  // namespace contactcheck
