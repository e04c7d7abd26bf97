// The historic triangle detectors against brute force: every triangle against every other by the
// exact test. What holds a broad phase to be complete holds for all three.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <thread>

#include "tests/core/detect/bare_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::at_rest;
using test::FrameData;
using test::generic_soup;
using test::grid_soup;
using test::prepared;
using test::scaled;
using test::Scene;
using test::still;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Pairs in one set but not in the other, with exact coordinates: ids alone are no diagnosis.
std::string differences(const FrameData& frame, const Scene& scene,
                        const std::vector<ElementPair>& got,
                        const std::vector<ElementPair>& truth) {
  std::vector<ElementPair> off;
  std::set_symmetric_difference(got.begin(), got.end(), truth.begin(), truth.end(),
                                std::back_inserter(off));
  std::ostringstream out;
  if (off.empty()) return "";
  const ElementPair& p = off[0];
  out << off.size() << " of " << truth.size() << " differ, first "
      << (std::binary_search(truth.begin(), truth.end(), p) ? "missed" : "spurious")
      << std::hexfloat;
  for (const auto& [body, triangle] : {std::pair(p.body_a, p.a), std::pair(p.body_b, p.b)}) {
    out << "\n body " << body << " triangle " << triangle;
    for (std::uint32_t v : scene.bodies[body].shape->mesh.triangles[triangle])
      out << "\n  " << frame.vertices[body][v].transpose();
  }
  return out.str();
}

class TriangleDetectors : public ::testing::TestWithParam<const char*> {
 protected:
  static std::unique_ptr<Detector> make(const Scene& scene) { return prepared(GetParam(), scene); }

  /// "" when both questions are answered exactly in the first frame.
  static std::string check(const Scene& scene) {
    const auto detector = make(scene);
    return check(scene, *detector, scene.frames[0]);
  }
  static std::string check(const Scene& scene, Detector& detector, const FrameData& frame) {
    ContactSet truth;
    truth.triangles = true_pairs(scene, frame);
    truth.canonicalize();
    const ContactSet got = answer(detector, frame, Question::kTriangles);
    const ContactSet boolean = answer(detector, frame, Question::kBody);
    if (got.triangles != truth.triangles)
      return differences(frame, scene, got.triangles, truth.triangles);
    if (got.bodies != truth.bodies || boolean.bodies != truth.bodies)
      return "other pairs of bodies";
    return boolean.triangles.empty() ? "" : "triangles in the answer about bodies";
  }
};

// Options at both ends: one triangle per leaf, all in one; cells of which every triangle meets too
// many, one cell for all; one bucket.
INSTANTIATE_TEST_SUITE_P(All, TriangleDetectors,
                         ::testing::Values("spatial-hash", "spatial-hash:cell=0.05",
                                           "spatial-hash:cell=1000,table=1", "aabb-tree",
                                           "aabb-tree:leaf=1", "aabb-tree:leaf=64", "sphere-tree",
                                           "sphere-tree:leaf=1", "sphere-tree:leaf=64", "ffd-lazy",
                                           "full-refit"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

TEST_P(TriangleDetectors, ClaimExactClosedSurfacesInDouble) {
  const auto detector = make(still({}));
  const Semantics& semantics = detector->semantics();
  std::vector<Level> levels = {Level::kBody, Level::kTriangle};
  std::vector<Question> questions = {Question::kTriangles, Question::kBody};
  const std::string name = GetParam();
  if (name.starts_with("aabb-tree") || name == "ffd-lazy" || name == "full-refit") {
    levels.insert(levels.end(),
                  {Level::kSelf, Level::kSelfVertex, Level::kSelfEdge, Level::kSelfBody});
    questions.push_back(Question::kSelf);
  }
  if (name == "ffd-lazy" || name == "full-refit") {
    levels.insert(levels.end(), {Level::kImpactVf, Level::kImpactEe, Level::kImpactTriangle,
                                 Level::kImpact, Level::kImpactSelfVf, Level::kImpactSelfEe});
    questions.insert(questions.end(), {Question::kImpacts, Question::kSelfImpacts});
  }
  EXPECT_EQ(semantics.levels, levels);
  EXPECT_EQ(semantics.questions, questions);
  EXPECT_TRUE(semantics.exact);
  EXPECT_TRUE(semantics.closed);
  EXPECT_FALSE(semantics.solid);
  EXPECT_EQ(detector->needs_vertices(), GetParam() != std::string("ffd-lazy"));
  EXPECT_THAT(detector->notes(), IsEmpty());
}

TEST_P(TriangleDetectors, GenericSoups) {
  test::TriangleSource random(301);
  for (int round = 0; round < 6; ++round) {
    const Scene scene = still(
        {generic_soup(random, 60), generic_soup(random, 1 + 20 * round), generic_soup(random, 35)});
    ASSERT_GT(true_pairs(scene, scene.frames[0]).size(), 20u);
    EXPECT_EQ(check(scene), "") << round;
  }
}

TEST_P(TriangleDetectors, SoupsOfTouchingCoplanarAndDegenerateTriangles) {
  test::TriangleSource random(302);
  for (int round = 0; round < 6; ++round) {
    const Scene scene =
        still({grid_soup(random, 60, 4), grid_soup(random, 50, 4), grid_soup(random, 1, 4)});
    ASSERT_GT(true_pairs(scene, scene.frames[0]).size(), 20u);
    EXPECT_EQ(check(scene), "") << round;
  }
}

TEST_P(TriangleDetectors, DeformedBodiesInEveryFrame) {
  for (std::uint64_t seed : {1, 2, 3}) {
    const Scene scene = test::approach({.seed = seed}, 4);
    const auto detector = make(scene);
    for (const FrameData& frame : scene.frames) EXPECT_EQ(check(scene, *detector, frame), "");
  }
}

TEST_P(TriangleDetectors, SpheresFromApartToOneInsideTheOther) {
  const TriangleMesh large = test::sphere_mesh(Vec3::Zero(), 1.0, 2);
  const TriangleMesh small = test::sphere_mesh(Vec3::Zero(), 0.5, 2);
  for (const auto& [x, contact] : {std::pair(1.6, false), std::pair(1.45, true),
                                   std::pair(0.7, true), std::pair(0.1, false)}) {
    const Scene scene = still({large, scaled(small, 1.0, Vec3(x, 0.03, 0.01))});
    ASSERT_EQ(!true_pairs(scene, scene.frames[0]).empty(), contact) << x;
    EXPECT_EQ(check(scene), "") << x;
  }
}

TEST_P(TriangleDetectors, CubesThatTouchInAFaceAnEdgeOrACorner) {
  const TriangleMesh cube = test::unit_box_mesh(2);
  for (const Vec3& offset : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(-1, -1, -1), Vec3(0.25, 1, 0.25)}) {
    const Scene scene = still({cube, scaled(cube, 1.0, offset)});
    ASSERT_FALSE(true_pairs(scene, scene.frames[0]).empty());
    EXPECT_EQ(check(scene), "") << offset.transpose();
  }
  const Vec3 apart(std::nextafter(1.0, 2.0), 0, 0);  // one ulp
  EXPECT_THAT(true_pairs(still({cube, scaled(cube, 1.0, apart)}),
                         at_rest(still({cube, scaled(cube, 1.0, apart)}).bodies)),
              IsEmpty());
  EXPECT_EQ(check(still({cube, scaled(cube, 1.0, apart)})), "");
}

TEST_P(TriangleDetectors, IdenticalMeshesAndInstancesOfOneShape) {
  const auto shape = make_bare_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 1));
  Scene scene;
  for (int i = 0; i < 4; ++i) scene.bodies.push_back({"instance", shape});
  scene.frames = {at_rest(scene.bodies)};
  const auto detector = make(scene);
  EXPECT_EQ(check(scene, *detector, scene.frames[0]), "");
  EXPECT_THAT(answer(*detector, scene.frames[0], Question::kBody).bodies, SizeIs(6));
  // Each instance has its own boxes: disjoint, in a row of touching ones, one turned inside out.
  FrameData row = scene.frames[0];
  for (std::size_t i = 0; i < 4; ++i)
    for (Vec3& v : row.vertices[i]) v = Vec3((i == 2 ? -v.x() : v.x()) + 2.0 * i, v.y(), v.z());
  row.nodes = row.vertices;  // bodies without a lattice
  EXPECT_EQ(check(scene, *detector, row), "");
  EXPECT_THAT(answer(*detector, row, Question::kBody).bodies, SizeIs(3));
}

TEST_P(TriangleDetectors, NoBodyOneBodyAndBodiesOfOneTriangle) {
  EXPECT_EQ(check(still({})), "");
  EXPECT_EQ(check(still({test::unit_box_mesh(1)})), "");
  const TriangleMesh flat = test::triangle_mesh(Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0));
  const TriangleMesh needle = test::triangle_mesh(Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(0, 0, 0.5));
  const TriangleMesh point = test::triangle_mesh(Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0));
  const Scene scene = still({flat, needle, point, scaled(flat, 1.0, Vec3(0, 0, 1e-9))});
  EXPECT_EQ(check(scene), "");
  EXPECT_THAT(true_pairs(scene, scene.frames[0]), SizeIs(4));
}

TEST_P(TriangleDetectors, FramesInAnyOrderLeaveNoTrace) {
  const Scene scene = test::approach({.seed = 5}, 4);
  const auto detector = make(scene);
  std::vector<ContactSet> first;
  for (const FrameData& frame : scene.frames)
    first.push_back(answer(*detector, frame, Question::kTriangles));
  ASSERT_THAT(first[0].triangles, IsEmpty());
  for (std::size_t f : {3u, 0u, 2u, 2u, 1u, 3u, 0u}) {
    answer(*detector, scene.frames[(f + 1) % 4], Question::kBody);
    EXPECT_EQ(answer(*detector, scene.frames[f], Question::kTriangles).triangles,
              first[f].triangles);
  }
}

TEST_P(TriangleDetectors, SwappedBodiesGiveTheSwappedAnswer) {
  test::TriangleSource random(303);
  const TriangleMesh one = generic_soup(random, 50), other = grid_soup(random, 30, 1);
  const Scene scene = still({one, other}), swapped = still({other, one});
  std::vector<ElementPair> turned;
  for (const ElementPair& p :
       answer(*make(swapped), swapped.frames[0], Question::kTriangles).triangles)
    turned.push_back({p.body_a, p.body_b, p.b, p.a});
  canonicalize(turned);
  EXPECT_FALSE(turned.empty());
  EXPECT_EQ(answer(*make(scene), scene.frames[0], Question::kTriangles).triangles, turned);
}

TEST_P(TriangleDetectors, UpdatedStructureAnswersAsAFreshOne) {
  const Scene scene = still({test::sphere_mesh(Vec3::Zero(), 1.0, 2), test::unit_box_mesh(3)});
  const auto updated = make(scene);
  FrameData frame = scene.frames[0];
  for (int step = 0; step < 5; ++step) {
    // Far beyond what the structure was built for: sheared, stretched, blown up.
    for (Vec3& v : frame.vertices[0])
      v = Vec3(1.5 * v.x() + 0.4 * v.y(), v.y() - 0.3 * v.z() * v.z(), std::sin(3.0 * v.x()));
    frame.nodes = frame.vertices;
    std::vector<TriangleMesh> deformed;
    for (std::size_t b = 0; b < 2; ++b)
      deformed.push_back({frame.vertices[b], scene.bodies[b].shape->mesh.triangles});
    const Scene fresh = still(deformed);
    EXPECT_EQ(answer(*updated, frame, Question::kTriangles).triangles,
              answer(*make(fresh), fresh.frames[0], Question::kTriangles).triangles)
        << step;
    EXPECT_EQ(check(scene, *updated, frame), "") << step;
  }
}

TEST_P(TriangleDetectors, PrepareAgainForgetsTheFirstScene) {
  const Scene first =
      still({test::unit_box_mesh(2), test::unit_box_mesh(1), test::unit_box_mesh(1)});
  const Scene second = still({test::sphere_mesh(Vec3::Zero(), 1.0, 1), test::unit_box_mesh(3)});
  const auto detector = make(first);
  answer(*detector, first.frames[0], Question::kTriangles);
  detector->prepare(second.bodies);
  EXPECT_EQ(check(second, *detector, second.frames[0]), "");
}

// Squares of coordinates underflow to 0 or overflow to infinity, mean edges and hash keys leave
// their ranges: no pair is lost.
TEST_P(TriangleDetectors, ExtremeScales) {
  for (double scale : {0x1p-1074, 1e-300, 1e-160, 1e155, 1e300}) {
    test::TriangleSource random(304);
    const Scene scene =
        still({scaled(grid_soup(random, 25, 2), scale), scaled(grid_soup(random, 25, 2), scale)});
    ASSERT_GT(true_pairs(scene, scene.frames[0]).size(), 5u);
    EXPECT_EQ(check(scene), "") << scale;
  }
}

TEST_P(TriangleDetectors, ExtremeOffsets) {
  const TriangleMesh cube = test::unit_box_mesh(2);
  const Vec3 far(1e300, -1e300, 1.7e308);
  EXPECT_EQ(check(still({scaled(cube, 1e300, far), scaled(cube, 1e299, far)})), "");
  // Cubes of 1e-160 side by side; from touching to far away in their own measure.
  for (double x : {1e-160, 1.5e-160, 1e-150}) {
    const Scene scene = still({scaled(cube, 1e-160), scaled(cube, 1e-160, Vec3(x, 0, 0))});
    EXPECT_EQ(!true_pairs(scene, scene.frames[0]).empty(), x == 1e-160);
    EXPECT_EQ(check(scene), "") << x;
  }
}

TEST_P(TriangleDetectors, TrianglesOfVeryDifferentSizes) {
  const TriangleMesh cube = test::unit_box_mesh(2);
  for (double size : {1e3, 1e150, 1e300}) {
    const TriangleMesh sheet =
        test::triangle_mesh(Vec3(-size, -size, 0.5), Vec3(size, -size, 0.5), Vec3(0, size, 0.5));
    const Scene scene = still({cube, sheet, scaled(cube, 1e-3, Vec3(0.5, 0.5, 0.4995))});
    EXPECT_THAT(answer(*make(scene), scene.frames[0], Question::kBody).bodies,
                ElementsAre(BodyPair{0, 1}, BodyPair{1, 2}));
    EXPECT_EQ(check(scene), "") << size;
  }
}

TEST_P(TriangleDetectors, IntegerTranslationLeavesTheAnswer) {
  test::TriangleSource random(305);
  const Scene scene = still({grid_soup(random, 40, 3), grid_soup(random, 40, 3)});
  const auto detector = make(scene);
  const ContactSet before = answer(*detector, scene.frames[0], Question::kTriangles);
  ASSERT_GT(before.triangles.size(), 10u);
  for (const Vec3& shift : {Vec3(17, -3, 5), Vec3(-1e6, 1e9, 1), Vec3(0x1p40, 0, -0x1p40)}) {
    FrameData moved = scene.frames[0];
    for (auto& vertices : moved.vertices)
      for (Vec3& v : vertices) v += shift;
    EXPECT_EQ(answer(*detector, moved, Question::kTriangles).triangles, before.triangles)
        << shift.transpose();
  }
}

TEST_P(TriangleDetectors, QueriesRepeatAndAppend) {
  const Scene scene = still({test::unit_box_mesh(2), test::sphere_mesh(Vec3::Zero(), 0.7, 2)});
  const auto detector = make(scene);
  const Frame frame = scene.frames[0].frame();
  detector->update(frame);
  ContactSet out;
  out.bodies = {{7, 8}};
  detector->query(Question::kBody, out);
  EXPECT_THAT(out.bodies, ElementsAre(BodyPair{7, 8}, BodyPair{0, 1}));
  detector->query(Question::kTriangles, out);
  const std::size_t once = out.triangles.size();
  // Exact size: each candidate is visited once, so nothing is reported twice.
  EXPECT_EQ(once, true_pairs(scene, scene.frames[0]).size());
  detector->query(Question::kTriangles, out);
  EXPECT_EQ(out.triangles.size(), 2 * once);
}

TEST_P(TriangleDetectors, TwoOnTwoThreadsDoNotMeet) {
  const Scene scene = test::approach({.seed = 6}, 4);
  const auto run = [&](std::vector<ContactSet>& out) {
    const auto detector = make(scene);
    for (int round = 0; round < 3; ++round)
      for (const FrameData& frame : scene.frames)
        out.push_back(answer(*detector, frame, Question::kTriangles));
  };
  std::vector<ContactSet> alone, left, right;
  run(alone);
  std::thread other([&] { run(left); });
  run(right);
  other.join();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(left[i].triangles, alone[i].triangles);
    EXPECT_EQ(right[i].triangles, alone[i].triangles);
  }
}

TEST_P(TriangleDetectors, TraceTellsCandidatesAndWhatWasVisited) {
  Scene scene =
      still({test::sphere_mesh(Vec3::Zero(), 1.0, 3), test::sphere_mesh(Vec3(1.9, 0.1, 0), 1.0, 3),
             test::sphere_mesh(Vec3(9, 0, 0), 1.0, 1)});
  const auto detector = make(scene);
  const ContactSet got = answer(*detector, scene.frames[0], Question::kTriangles);
  const Frame frame = scene.frames[0].frame();
  detector->update(frame);
  const StageTrace trace = detector->trace();
  ASSERT_THAT(trace.stages, SizeIs(2));
  const StageRecord &broad = trace.stages[0], &exact = trace.stages[1];
  EXPECT_TRUE(std::string(GetParam()).starts_with(broad.name) || broad.name == "boxes");
  EXPECT_EQ(broad.in, 512u * 512 + 2 * 512 * 32);
  EXPECT_EQ(broad.kind, StageRecord::Kind::kTriangles);
  EXPECT_EQ(broad.out, broad.elements.size());
  EXPECT_TRUE(std::is_sorted(broad.elements.begin(), broad.elements.end()));
  EXPECT_TRUE(std::includes(broad.elements.begin(), broad.elements.end(), got.triangles.begin(),
                            got.triangles.end()));
  EXPECT_LT(broad.out, broad.in);
  EXPECT_GT(broad.visited, 0u);
  EXPECT_FALSE(broad.visited_unit.empty());
  EXPECT_EQ(exact.name, "triangles");
  EXPECT_EQ(exact.in, broad.out);
  EXPECT_EQ(exact.out, got.triangles.size());
  EXPECT_EQ(exact.elements, got.triangles);
  EXPECT_EQ(exact.visited_unit, "");
  EXPECT_GT(exact.out, 0u);
}

TEST_P(TriangleDetectors, BodiesApartCostNothing) {
  const Scene scene =
      still({test::sphere_mesh(Vec3::Zero(), 1.0, 2), test::sphere_mesh(Vec3(9, 0, 0), 1.0, 2)});
  const auto detector = make(scene);
  answer(*detector, scene.frames[0], Question::kTriangles);
  EXPECT_LE(detector->trace().stages[0].visited, 1u);
  EXPECT_EQ(detector->trace().stages[0].out, 0u);
}

TEST(HistoricDetectors, VisitFarLessThanBruteForceByDefault) {
  const Scene scene = still(
      {test::sphere_mesh(Vec3::Zero(), 1.0, 4), test::sphere_mesh(Vec3(1.9, 0.1, 0), 1.0, 4)});
  for (const char* name : {"spatial-hash", "aabb-tree", "sphere-tree"}) {
    const auto detector = prepared(name, scene);
    ASSERT_FALSE(answer(*detector, scene.frames[0], Question::kTriangles).triangles.empty());
    const StageRecord broad = detector->trace().stages[0];
    EXPECT_GT(broad.visited, broad.out / 100) << name;
    EXPECT_LT(broad.visited, broad.in / 100) << name;
    EXPECT_LT(broad.out, broad.in / 100) << name;
  }
}

}  // namespace
}  // namespace contactcheck
