#include <gmock/gmock.h>
#include <tbb/global_control.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <cmath>
#include <limits>
#include <thread>

#include "core/types/check.h"
#include "tests/reference/adapters/adapter_world.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kEmbree = "embree";

std::vector<ElementPair> triangles(const World& world) {
  return ask(kEmbree, world, Question::kTriangles).triangles;
}

World embree_spheres() {
  return World({sphere_mesh(Vec3(0, 0, 0), 1, 3), sphere_mesh(Vec3(1.1, 0.3, 0.2), 0.9, 3)});
}

World scaled_spheres(double factor) {
  World world({sphere_mesh(Vec3(0, 0, 0), 1, 2), sphere_mesh(Vec3(1.1, 0.3, 0.2), 0.9, 2)});
  for (std::vector<Vec3>& body : world.vertices)
    for (Vec3& v : body) v *= factor;
  return world;
}

/// One mesh of unconnected triangles.
TriangleMesh soup(const std::vector<TrianglePoints>& triangles) {
  TriangleMesh mesh;
  for (const TrianglePoints& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

std::vector<BodyPair> bodies_of(const std::vector<ElementPair>& pairs) {
  ContactSet set;
  set.triangles = pairs;
  set.canonicalize();
  return set.bodies;
}

TEST(Embree, ClaimsExactClosedSurfacesInDouble) {
  const Semantics semantics = make_detector(kEmbree)->semantics();
  EXPECT_THAT(semantics.levels,
              ElementsAre(Level::kBody, Level::kTriangle, Level::kSelf, Level::kSelfVertex,
                          Level::kSelfEdge, Level::kSelfBody));
  EXPECT_THAT(semantics.questions,
              ElementsAre(Question::kTriangles, Question::kBody, Question::kSelf));
  EXPECT_TRUE(semantics.exact);
  EXPECT_TRUE(semantics.closed);
  EXPECT_FALSE(semantics.solid);
  EXPECT_EQ(semantics.precision, Precision::kDouble);
  EXPECT_EQ(semantics.depth, DepthKind::kNone);
}

TEST(Embree, VersionIsThatOfTheHeaders) {
  EXPECT_THAT(adapters::library_versions().at("embree"),
              ::testing::MatchesRegex("3\\.[0-9]+\\.[0-9]+"));
}

TEST(Embree, EveryBuildFindsTheTruePairsOfBodiesThatMoveAndStretch) {
  World world = embree_spheres();
  std::vector<std::unique_ptr<Detector>> detectors;
  for (const char* build : {"embree", "embree:build=low", "embree:build=medium"})
    detectors.push_back(prepared(build, world));
  stretch(world, 0);
  for (const auto& detector : detectors) {
    detector->update(world.frame());
    EXPECT_EQ(compare(world, ask(*detector, Question::kTriangles).triangles), "");
  }
}

TEST(Embree, OverlappingSpheresGiveExactlyTheTruePairs) {
  const World world = embree_spheres();
  ASSERT_THAT(true_pairs(world), SizeIs(Gt(50u)));
  EXPECT_EQ(compare(world, triangles(world)), "");
}

TEST(Embree, SwappedBodiesGiveTheSwappedPairs) {
  const World world = embree_spheres();
  World swapped = world;
  std::swap(swapped.bodies[0], swapped.bodies[1]);
  std::swap(swapped.vertices[0], swapped.vertices[1]);
  std::vector<ElementPair> expected;
  for (const ElementPair& p : triangles(world)) expected.push_back({0, 1, p.b, p.a});
  canonicalize(expected);
  EXPECT_EQ(triangles(swapped), expected);
}

TEST(Embree, RandomTrianglesGiveExactlyTheTruePairs) {
  TriangleSource source(31);
  std::size_t in_contact = 0, pairs = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<TrianglePoints> a, b;
    for (int i = 0; i < 30; ++i) a.push_back(source.triangle(source.point(Vec3::Zero(), 2), 1.5));
    for (int i = 0; i < 30; ++i) b.push_back(source.triangle(source.point(Vec3::Zero(), 2), 1.5));
    const World world({soup(a), soup(b)});
    const std::vector<ElementPair> got = triangles(world);
    ASSERT_EQ(compare(world, got), "") << "round " << round;
    in_contact += got.size(), pairs += 900;
  }
  EXPECT_GT(in_contact, pairs / 100);
  EXPECT_LT(in_contact, pairs / 4);
}

// Small integers (points, segments, shared corners and planes are common), and triangles that are
// off the features of others by single ulps, far below what a float can tell apart.
TEST(Embree, DegenerateTrianglesGiveExactlyTheTruePairs) {
  TriangleSource source(32);
  for (int round = 0; round < 40; ++round) {
    std::vector<TrianglePoints> a, b;
    for (int i = 0; i < 20; ++i) {
      a.push_back(source.grid_triangle(2));
      b.push_back(source.grid_triangle(2));
      a.push_back(source.triangle(source.point(Vec3::Zero(), 2), 1));
      b.push_back(source.near_degenerate_partner(a.back(), 1));
    }
    const World world({soup(a), soup(b)});
    const std::vector<ElementPair> got = triangles(world);
    ASSERT_THAT(got, SizeIs(Gt(20u)));
    ASSERT_EQ(compare(world, got), "") << "round " << round;
  }
}

TEST(Embree, CoincidentCubesGiveExactlyTheTruePairs) {
  const World world({unit_box_mesh(3), unit_box_mesh(3)});
  EXPECT_EQ(compare(world, triangles(world)), "");
}

TEST(Embree, TouchingBoxesAreInContactAndNeighbouringDoublesDecide) {
  const TriangleMesh box = unit_box_mesh(2);
  for (const Vec3& side : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(-1, 0, -1)}) {
    const World touching({box, moved(box, 1.0, side)});
    EXPECT_FALSE(triangles(touching).empty()) << side.transpose();
    EXPECT_EQ(compare(touching, triangles(touching)), "") << side.transpose();
    World apart = touching;
    for (Vec3& v : apart.vertices[1])
      for (int axis = 0; axis < 3; ++axis) v[axis] += side[axis] * 0x1p-52;
    EXPECT_THAT(triangles(apart), IsEmpty()) << side.transpose();
  }
}

TEST(Embree, SeparatedAndContainedBodiesAreNotInContact) {
  const TriangleMesh sphere = sphere_mesh(Vec3(0, 0, 0), 1, 3);
  EXPECT_THAT(triangles(World({sphere, moved(sphere, 1, Vec3(5, 0, 0))})), IsEmpty());
  EXPECT_THAT(triangles(World({sphere, moved(sphere, 1, Vec3(1.3, 1.3, 1.3))})), IsEmpty());
  EXPECT_THAT(triangles(World({sphere, moved(sphere, 0.5)})), IsEmpty());
}

TEST(Embree, SingleTrianglesAndSingleBodiesAreAnswered) {
  const TriangleMesh plate = triangle_mesh(Vec3(-1, -1, 0), Vec3(3, -1, 0), Vec3(-1, 3, 0));
  const TriangleMesh needle = triangle_mesh(Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(0.1, 0, 1));
  EXPECT_THAT(triangles(World({plate, needle})), ElementsAre(ElementPair{0, 1, 0, 0}));
  EXPECT_THAT(triangles(World({plate})), IsEmpty());
  EXPECT_THAT(triangles(World({})), IsEmpty());
}

// Embree itself leaves out what is beyond 1.8e18, flushes denormal floats to zero and aborts over
// boxes without extent.
TEST(Embree, AnyScaleGivesExactlyTheTruePairs) {
  for (const double factor : {1e-310, 1e-300, 1e-150, 1e-45, 1e-40, 1e-38, 1e-20, 1e-6, 1e6, 1e18,
                              1e19, 1e30, 1e38, 1e39, 1e150, 8e307}) {
    const World world = scaled_spheres(factor);
    const std::vector<ElementPair> got = triangles(world);
    EXPECT_THAT(got, SizeIs(Gt(25u))) << factor;
    EXPECT_EQ(compare(world, got), "") << factor;
  }
}

TEST(Embree, TwoTrianglesThatCrossAreFoundAtAnyScale) {
  for (const double s : {5e-324, 1e-310, 1e-40, 1e-38, 1.0, 1e30, 1e308}) {
    const World world({triangle_mesh(s * Vec3(-1, -1, 0), s * Vec3(1, -1, 0), s * Vec3(0, 1, 0)),
                       triangle_mesh(s * Vec3(0, 0, -1), s * Vec3(0, 0, 1), s * Vec3(1, 0, 1))});
    EXPECT_THAT(triangles(world), ElementsAre(ElementPair{0, 1, 0, 0})) << s;
  }
}

TEST(Embree, FarFromTheOriginIsExact) {
  for (const double offset : {1e3, 1e7, 1e9}) {
    World world = embree_spheres();
    for (std::vector<Vec3>& body : world.vertices)
      for (Vec3& v : body) v += Vec3(offset, -offset, offset);
    EXPECT_EQ(compare(world, triangles(world)), "") << offset;
  }
}

TEST(Embree, BodiesFlattenedToPointsAreAnswered) {
  World world({unit_box_mesh(2), unit_box_mesh(2)});
  const auto detector = prepared(kEmbree, world);
  for (const Vec3& p : {Vec3(5, 5, 5), Vec3(0.5, 0.25, 1.0), Vec3(0, 0, 0), Vec3(1.5e-38, 0, 0),
                        Vec3(0, 1e-320, 0)}) {
    for (Vec3& v : world.vertices[1]) v = p;
    detector->update(world.frame());
    EXPECT_EQ(compare(world, ask(*detector, Question::kTriangles).triangles), "") << p.transpose();
  }
  for (Vec3& v : world.vertices[0]) v = Vec3(0, 1e-320, 0);
  detector->update(world.frame());
  EXPECT_THAT(ask(*detector, Question::kTriangles).triangles, SizeIs(48u * 48u));
}

// The first commit is that of the rest shapes: here they have no extent in one, two or three axes.
TEST(Embree, BodiesFlatAtRestAreAnswered) {
  const TriangleMesh box = unit_box_mesh(2);
  for (const Vec3& extent :
       {Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 0, 0), Vec3(1e-39, 0, 0), Vec3(0, 1e-320, 1e-320)}) {
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(1, 0.5, 0), Vec3(0.125, 0.3, 1)}) {
      TriangleMesh flat = box;
      for (Vec3& v : flat.vertices) v = v.cwiseProduct(extent) + place;
      const World world({box, flat}), both({flat, flat});
      EXPECT_EQ(compare(world, triangles(world)), "") << extent.transpose();
      EXPECT_EQ(compare(both, triangles(both)), "") << extent.transpose();
    }
  }
}

// Embree aborts over two to four primitives whose boxes together have no extent.
TEST(Embree, FewTrianglesWithoutExtentAreAnswered) {
  for (const double at : {0.0, 1.0, 0.3, 1e-30, 1e-320}) {
    for (std::size_t count = 1; count <= 5; ++count) {
      const Vec3 p(at, at, at);
      const TriangleMesh points = soup(std::vector(count, TrianglePoints{p, p, p}));
      const World world({points, unit_box_mesh(1)});
      EXPECT_EQ(compare(world, triangles(world)), "") << at << " " << count;
      EXPECT_THAT(triangles(World({points, points})), SizeIs(count * count));
    }
  }
}

// The test that ends the traversal runs where Embree has set flush-to-zero: with that, triangles of
// denormal size would be points in contact.
TEST(Embree, BodiesAreThoseOfTheTruePairsAtAnyScaleAndTurn) {
  TriangleSource source(33);
  std::size_t met = 0, apart = 0;
  for (const double scale : {1.0, 0x1p-1060, 0x1p-1030, 1e300}) {
    for (int round = 0; round < 60; ++round) {
      std::vector<TriangleMesh> meshes;
      for (int body = 0; body < 3; ++body) {
        std::vector<TrianglePoints> triangles;
        for (int i = 0; i < 4; ++i) {
          triangles.push_back(source.triangle(source.point(Vec3::Zero(), 2), 1.5));
          for (Vec3& p : triangles.back()) p *= scale;
        }
        meshes.push_back(soup(triangles));
      }
      const World world(meshes);
      const std::vector<BodyPair> expected = bodies_of(true_pairs(world));
      ASSERT_EQ(ask(kEmbree, world, Question::kBody).bodies, expected) << scale << " " << round;
      met += expected.size(), apart += 3 - expected.size();
    }
  }
  EXPECT_GT(met, 100u);
  EXPECT_GT(apart, 100u);
}

TEST(Embree, VertexThatIsNotFiniteIsRefused) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    World world = embree_spheres();
    const auto detector = prepared(kEmbree, world);
    world.vertices[1][7].y() = bad;
    EXPECT_THROW(detector->update(world.frame()), RefusedInput) << bad;
  }
}

TEST(Embree, UpdatesGiveTheAnswersOfAFreshDetector) {
  World world({sphere_mesh(Vec3(0, 0, 0), 1, 3), sphere_mesh(Vec3(3, 0.07, 0.03), 0.95, 3)});
  const auto updated = prepared(kEmbree, world);
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

TEST(Embree, EarlierFramesLeaveNoTrace) {
  const World start = embree_spheres();
  World world = start;
  const auto detector = prepared(kEmbree, start);
  const ContactSet before = ask(*detector, Question::kTriangles);
  ASSERT_FALSE(before.triangles.empty());
  for (Vec3& v : world.vertices[1]) v = 1e6 * v;
  detector->update(world.frame());
  EXPECT_EQ(compare(world, ask(*detector, Question::kTriangles).triangles), "");
  detector->update(start.frame());
  detector->update(start.frame());  // without motion
  EXPECT_EQ(ask(*detector, Question::kTriangles).triangles, before.triangles);
}

TEST(Embree, PrepareAgainForgetsTheFirstScene) {
  const World first({unit_box_mesh(2), unit_box_mesh(2), unit_box_mesh(3)});
  const World second = embree_spheres();
  const auto detector = prepared(kEmbree, first);
  detector->prepare(second.bodies);
  detector->update(second.frame());
  EXPECT_EQ(compare(second, ask(*detector, Question::kTriangles).triangles), "");
}

TEST(Embree, RepeatedQueriesGiveTheSameAnswerAndAppend) {
  const World world = embree_spheres();
  const auto detector = prepared(kEmbree, world);
  const ContactSet first = ask(*detector, Question::kTriangles);
  ContactSet out;
  out.bodies.push_back({7, 8});
  detector->query(Question::kBody, out);
  EXPECT_THAT(out.bodies, ElementsAre(BodyPair{7, 8}, BodyPair{0, 1}));
  EXPECT_EQ(ask(*detector, Question::kTriangles).triangles, first.triangles);
}

TEST(Embree, EightInstancesOfOneShapeAnswerAllQuestionsAlike) {
  World world({8, unit_box_mesh(2)});
  for (std::uint32_t b = 0; b < 8; ++b)
    for (Vec3& v : world.vertices[b]) v += 0.9 * Vec3(b % 2, b / 2 % 2, b / 4);
  for (Vec3& v : world.vertices[7]) v += Vec3(1, 0, 0);  // one of them apart from some
  const auto detector = prepared(kEmbree, world);
  const ContactSet pairs = ask(*detector, Question::kTriangles);
  EXPECT_EQ(compare(world, pairs.triangles), "");
  EXPECT_EQ(ask(*detector, Question::kBody).bodies, bodies_of(true_pairs(world)));
  EXPECT_EQ(pairs.bodies, bodies_of(true_pairs(world)));
  EXPECT_THAT(pairs.bodies, SizeIs(::testing::AllOf(Gt(20u), ::testing::Lt(28u))));
}

// Bodies whose boxes meet and whose surfaces do not: candidates, no contact.
TEST(Embree, StagesKeepAllTruePairs) {
  World world = embree_spheres();
  const auto detector = prepared(kEmbree, world);
  const StageTrace trace = detector->trace();
  ASSERT_THAT(trace.stages, SizeIs(2));
  const StageRecord &boxes = trace.stages[0], &exact = trace.stages[1];
  EXPECT_EQ(boxes.name, "rtcCollide");
  EXPECT_EQ(boxes.unit, "triangle pairs");
  EXPECT_EQ(boxes.in, 512u * 512u);
  EXPECT_EQ(boxes.out, boxes.elements.size());
  EXPECT_LT(boxes.out, boxes.in / 50);  // it culls
  EXPECT_EQ(exact.in, boxes.out);
  EXPECT_EQ(exact.elements, true_pairs(world));
  EXPECT_THAT(without(exact.elements, boxes.elements), IsEmpty());
  EXPECT_GT(boxes.out, exact.out);
}

std::vector<std::uint64_t> counts_of(Detector& detector) {
  std::vector<std::uint64_t> out;
  for (const Count& count : detector.counts()) out.push_back(count.value);
  return out;
}

// Whatever the batches, the answer is the same: only the counts tell that tests go eight at a time.
TEST(Embree, TestsEightCandidatesAtATime) {
  const World world = embree_spheres();
  const auto detector = prepared(kEmbree, world);
  EXPECT_THAT(counts_of(*detector), ElementsAre(0, 0));
  ask(*detector, Question::kTriangles);
  const std::vector<std::uint64_t> once = counts_of(*detector);
  EXPECT_GE(once.at(0), true_pairs(world).size());
  EXPECT_EQ(once.at(1), (once.at(0) + 7) / 8);  // of two bodies: one batch alone is not full
  ask(*detector, Question::kTriangles);
  EXPECT_THAT(counts_of(*detector), ElementsAre(2 * once.at(0), 2 * once.at(1)));
  detector->update(world.frame());
  EXPECT_THAT(counts_of(*detector), ElementsAre(0, 0));
}

// The first of them that holds a contact is the last.
TEST(Embree, TestsOneBatchOfBodiesThatMeetEverywhere) {
  const World world({unit_box_mesh(2), unit_box_mesh(2)});
  const auto detector = prepared(kEmbree, world);
  ask(*detector, Question::kBody);
  EXPECT_THAT(counts_of(*detector), ElementsAre(8, 1));
}

// A third body, none of whose candidates may turn up as those of the other two.
TEST(Embree, CandidatesAreThoseOfTheirOwnBodies) {
  const World pair = embree_spheres();
  const TriangleMesh third = sphere_mesh(Vec3(0.6, 0.1, 0), 0.4, 2);
  const World three({third, pair.bodies[0].shape->mesh, pair.bodies[1].shape->mesh});
  std::vector<ElementPair> alone = prepared(kEmbree, pair)->trace().stages.at(0).elements;
  for (ElementPair& p : alone) p.body_a = 1, p.body_b = 2;
  std::vector<ElementPair> among = prepared(kEmbree, three)->trace().stages.at(0).elements;
  std::erase_if(among, [](const ElementPair& p) { return p.body_a == 0; });
  EXPECT_EQ(among, alone);
}

TEST(Embree, LeavesTheFloatingPointStateAlone) {
#if defined(__SSE__)
  constexpr unsigned kSticky = 0x3fu;  // exception flags
  const World world = embree_spheres();
  const unsigned before = _mm_getcsr() & ~kSticky;
  const auto detector = prepared(kEmbree, world);
  EXPECT_EQ(_mm_getcsr() & ~kSticky, before);
  detector->update(world.frame());
  EXPECT_EQ(_mm_getcsr() & ~kSticky, before);
  ask(*detector, Question::kTriangles);
  EXPECT_EQ(_mm_getcsr() & ~kSticky, before);
  EXPECT_THAT(ask(*detector, Question::kBody).bodies, SizeIs(1));  // ends by an exception
  EXPECT_EQ(_mm_getcsr() & ~kSticky, before);
#else
  GTEST_SKIP() << "no MXCSR";
#endif
}

TEST(Embree, LeavesTheProcessItsThreads) {
  const auto limit = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const std::size_t before = limit();
  const auto detector = prepared(kEmbree, embree_spheres());
  EXPECT_EQ(limit(), before);
}

TEST(Embree, DetectorsOnTwoThreadsAnswerAsAlone) {
  const World first = embree_spheres();
  World second = embree_spheres();
  for (Vec3& v : second.vertices[1]) v += Vec3(0.2, -0.1, 0.3);
  const auto expected_first = triangles(first), expected_second = triangles(second);
  ASSERT_NE(expected_first, expected_second);
  const auto run = [](const World& world, const std::vector<ElementPair>& expected, int& wrong) {
    for (int round = 0; round < 20; ++round) wrong += triangles(world) != expected;
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
