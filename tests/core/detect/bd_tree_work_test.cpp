// What the detector bd-tree looks at: no sphere or vertex beyond those that a traversal needs.

#include <gmock/gmock.h>

#include <algorithm>

#include "core/detect/bd_tree_detector.h"
#include "tests/core/detect/bd_tree_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::bent;
using test::deformed_pair;
using test::prepared;
using test::Scene;
using test::twisted;
using ::testing::SizeIs;

struct Work {
  std::size_t spheres = 0, vertices = 0;
  std::uint64_t visited = 0, candidates = 0, brute_force = 0;
};

template <typename T = double>
Work work_of(const Scene& scene, const BdSettings& settings) {
  BdTreeDetectorOf<T> detector(settings);
  detector.prepare(scene.bodies);
  answer(detector, scene.frames[0], Question::kTriangles);
  Work work;
  for (const BdTreeOf<T>& tree : detector.trees()) {
    work.spheres += tree.evaluated_spheres();
    work.vertices += tree.mapped_vertices();
  }
  const StageTrace trace = detector.trace();
  work.visited = trace.stages[0].visited;
  work.candidates = trace.stages[0].out;
  work.brute_force = trace.stages[0].in;
  return work;
}

TEST(BdTreeLaziness, BodiesApartCostTheirRoots) {
  const Work work = work_of(deformed_pair(twisted, bent, {9.0}), {});
  EXPECT_EQ(work.spheres, 2u);
  EXPECT_EQ(work.vertices, 0u);
  EXPECT_EQ(work.visited, 1u);
  EXPECT_EQ(work.candidates, 0u);
}

TEST(BdTreeLaziness, TheCostFollowsTheContactAndNotTheMesh) {
  const Scene scene = deformed_pair(bent, bent, {1.8}, 4);  // 2048 triangles each
  const Work work = work_of(scene, {});
  const std::size_t vertices = 2 * scene.bodies[0].shape->mesh.vertices.size();
  EXPECT_EQ(work.brute_force, 2048u * 2048u);
  EXPECT_LT(work.candidates, work.brute_force / 50);
  EXPECT_LT(work.visited, work.brute_force / 50);
  EXPECT_GT(work.visited, 100u);
  EXPECT_LT(work.vertices, vertices / 2);
  EXPECT_GT(work.vertices, 10u);
  EXPECT_LT(work.spheres, 1500u);  // of about 2 x 2 x 2048 / 3
}

TEST(BdTreeLaziness, TheAnswerAboutBodiesStopsAtTheFirstPair) {
  const Scene scene = deformed_pair(bent, bent, {1.2}, 3);
  BdTreeDetector detector({});
  detector.prepare(scene.bodies);
  answer(detector, scene.frames[0], Question::kBody);
  const std::size_t boolean = detector.trees()[0].mapped_vertices();
  answer(detector, scene.frames[0], Question::kTriangles);
  EXPECT_GT(boolean, 0u);
  EXPECT_LT(boolean, detector.trees()[0].mapped_vertices());
}

TEST(BdTreeReference, TakesARigidMotionOutAndTheIdentityDoesNot) {
  const Scene scene =
      deformed_pair([](const Vec3& p) { return p; }, [](const Vec3& p) { return p; }, {1.95}, 3);
  BdSettings settings;
  settings.paper_bound = true;
  const Work affine = work_of(scene, settings);
  settings.reference = ReferenceKind::kRigid;
  const Work rigid = work_of(scene, settings);
  settings.reference = ReferenceKind::kNone;
  const Work none = work_of(scene, settings);
  EXPECT_LT(20 * affine.candidates, none.candidates);
  EXPECT_LT(20 * rigid.candidates, none.candidates);
  EXPECT_LE(affine.visited, rigid.visited + rigid.visited / 10);
}

// The local origin is no displacement: at rest far out, the identity excludes as much in floats.
TEST(BdTreeReference, NoneVisitsAsMuchInFloatsAsInDoubles) {
  BdSettings settings;
  settings.paper_bound = true;
  settings.reference = ReferenceKind::kNone;
  for (double x : {0.0, 1000.0}) {
    Scene scene;
    for (double place : {x, x + 1.9, x + 5.0})
      scene.bodies.push_back(
          test::make_body("", test::sphere_mesh(Vec3(place, -x, 0), 1.0, 3), {4, 4, 4}));
    std::vector<std::vector<Vec3>> rest;
    for (const Body& body : scene.bodies)
      rest.push_back(test::rest_nodes_at(*body.shape, Vec3::Zero()));
    scene.frames = {test::make_frame(scene.bodies, std::move(rest))};
    const Work doubles = work_of(scene, settings), floats = work_of<float>(scene, settings);
    EXPECT_GT(doubles.visited, 3u) << x << ": two meet";
    EXPECT_LT(doubles.visited, doubles.brute_force / 100) << x;
    EXPECT_LE(floats.visited, doubles.visited + doubles.visited / 10) << x;
  }
}

TEST(BdTreeBound, OfOursIsNeverWiderThanThePapersAndHelpsTwistedBodies) {
  const Scene scene = deformed_pair(twisted, twisted, {1.7}, 3);
  BdSettings paper;
  paper.paper_bound = true;
  const auto model = make_bd_model(*scene.bodies[0].shape, 4);
  BdTree tight(model, {}), loose(model, paper);
  tight.begin_frame(scene.frames[0].nodes[0]);
  loose.begin_frame(scene.frames[0].nodes[0]);
  for (std::uint32_t n = 0; n < model->spheres.size(); ++n)
    EXPECT_LE(tight.sphere(n).radius, loose.sphere(n).radius) << n;
  EXPECT_LT(2 * work_of(scene, {}).candidates, work_of(scene, paper).candidates);
}

TEST(BdTreeTrace, TellsCandidatesAndWhatWasVisited) {
  const Scene scene = deformed_pair(twisted, bent, {1.2});
  const std::vector<ElementPair> truth = true_pairs(scene, scene.frames[0]);
  const auto detector = prepared("bd-tree", scene);
  const Frame frame = scene.frames[0].frame();
  detector->update(frame);
  const StageTrace trace = detector->trace();
  ASSERT_THAT(trace.stages, SizeIs(2));
  const StageRecord &spheres = trace.stages[0], &exact = trace.stages[1];
  EXPECT_EQ(spheres.name, "spheres");
  EXPECT_EQ(spheres.unit, "triangle pairs");
  EXPECT_EQ(spheres.visited_unit, "sphere pairs");
  EXPECT_EQ(spheres.kind, StageRecord::Kind::kTriangles);
  EXPECT_EQ(spheres.in, 512u * 512u);
  EXPECT_EQ(spheres.out, spheres.elements.size());
  EXPECT_TRUE(
      std::includes(spheres.elements.begin(), spheres.elements.end(), truth.begin(), truth.end()));
  EXPECT_EQ(exact.name, "triangles");
  EXPECT_EQ(exact.in, spheres.out);
  EXPECT_EQ(exact.elements, truth);
  EXPECT_EQ(exact.out, exact.elements.size());
  EXPECT_LT(exact.out, exact.in);
}

}  // namespace
}  // namespace contactcheck
