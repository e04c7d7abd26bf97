// The oracle of steps against brute force in rational arithmetic over all pairs of elements; more
// of it is in tests/odd/odd_steps.cpp.

#include "reference/oracle/step_truth.h"

#include <gmock/gmock.h>

#include "core/types/impact.h"
#include "reference/oracle/oracle.h"
#include "tests/odd/step_brute_force.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::test::step_truth {
namespace {

using oracle::FirstImpact;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr oracle::WantedSteps kBoth{true, true};

std::string fault(const oracle::StepTruth& truth, const StepBruteForce& expected) {
  if (const std::string list = different_list(truth.contacts, expected.contacts()); !list.empty())
    return list;
  for (const BodyImpact& impact : truth.contacts.impacts)
    if (impact.time) return "a time in the lists";
  return expected.fault_of_first(truth.first, false);
}

struct Seen {
  std::size_t steps = 0, apart = 0, at_start = 0, later = 0, at_end = 0, starts_alone = 0, own = 0;
};

/// False after a fault.
bool agree(const StepScene& scene, Seen& seen) {
  const StepBruteForce expected(scene);
  oracle::StepOracle oracle(scene.bodies);
  const oracle::StepTruth truth = oracle.judge(scene.step(), expected.at_start(), kBoth);
  const std::string wrong = fault(truth, expected);
  EXPECT_EQ(wrong, "") << (wrong.empty() ? "" : text(scene));
  ++seen.steps;
  if (truth.first.empty()) ++seen.apart;
  for (const FirstImpact& first : truth.first) {
    ++(first.starts_in_contact ? seen.at_start : seen.later);
    if (first.latest == 1) ++seen.at_end;
  }
  // The step has contacts at its start that no vertex and no edge has.
  if (truth.contacts.impact_vertices.empty() && truth.contacts.impact_edges.empty())
    seen.starts_alone += truth.contacts.impact_triangles.size();
  seen.own += truth.contacts.self_impact_vertices.size() + truth.contacts.self_impact_edges.size();
  return wrong.empty();
}

/// Of tetrahedra or octahedra whose vertices all are whole numbers up to a limit.
StepScene draw_small(TriangleSource& random) {
  const int limit = 1 + random.below(3);
  std::vector<Body> bodies;
  NodesOfBodies start, end;
  for (int b = 0; b < 2; ++b) {
    TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 0);
    if (random.below(3) != 0) {
      mesh.vertices.resize(4);
      mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    }
    const auto places = [&] {
      std::vector<Vec3> out;
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        out.push_back(random.grid_point(limit));
      return out;
    };
    const Vec3 apart(b * random.below(4), 0, 0);
    start.push_back(places());
    end.push_back(places());
    if (random.below(4) == 0) end.back() = start.back();
    const Vec3 by = random.grid_point(2);
    for (Vec3& v : start.back()) v += apart;
    for (Vec3& v : end.back()) v += apart + by;
    if (random.below(8) == 0) end.back() = start.back();
    bodies.push_back({"small", make_bare_shape(mesh)});
  }
  return make_step_scene("small", std::move(bodies), std::move(start), std::move(end));
}

TEST(StepTruth, ThousandsOfSmallStepsOnGridsAgreeWithBruteForce) {
  TriangleSource random(901);
  Seen seen;
  while (seen.steps < 2000)
    if (!agree(draw_small(random), seen)) return;
  EXPECT_GT(seen.apart, 100u);
  EXPECT_GT(seen.at_start, 300u);
  EXPECT_GT(seen.later, 200u);
  EXPECT_GT(seen.at_end, 20u);
  EXPECT_GT(seen.own, 1000u);
}

TEST(StepTruth, DrawnScenesAgreeWithBruteForce) {
  TriangleSource random(902);
  Seen seen;
  for (const StepFamily family : kStepFamilies) {
    const int rounds = family == StepFamily::kGrid || family == StepFamily::kDegenerate ? 10 : 1;
    for (int round = 0; round < rounds; ++round) {
      const StepScene scene = draw_step_scene(random, family);
      std::size_t triangles = 0;
      for (const Body& body : scene.bodies) triangles += body.shape->mesh.triangles.size();
      if (triangles > 160) continue;
      if (!agree(scene, seen)) return;
    }
  }
  EXPECT_GT(seen.steps, 25u);
  EXPECT_GT(seen.own, 100u);
}

// Instances of one shape of 64 triangles.
TEST(StepTruth, LargerBodiesAgreeWithBruteForce) {
  TriangleSource random(903);
  Seen seen;
  const Body torus = make_body("torus", small_torus(true), {3, 3, 2});
  const std::vector<Body> bodies = {torus, torus};
  while (seen.steps < 24) {
    NodesOfBodies start, end;
    for (const Body& body : bodies) {
      const Vec3 from = random.point(Vec3::Zero(), 1.5), to = from + random.point(Vec3::Zero(), 2);
      start.emplace_back(), end.emplace_back();
      for (const Vec3& node : rest_nodes_at(*body.shape, Vec3::Zero())) {
        start.back().push_back(node + from);
        end.back().push_back(random.point(node + to, 0.4));
      }
    }
    if (!agree(make_step_scene("larger", bodies, std::move(start), std::move(end)), seen)) return;
  }
  EXPECT_GT(seen.at_start, 3u);
  EXPECT_GT(seen.later, 3u);
}

// Backwards the same vertices, triangles and edges meet.
TEST(StepTruth, BackwardsTheSameElementsMeet) {
  TriangleSource random(904);
  for (int round = 0; round < 300; ++round) {
    const StepScene scene =
        round % 4 == 0 ? draw_step_scene(random, StepFamily::kDegenerate) : draw_small(random);
    const StepScene back = reversed(scene);
    oracle::StepOracle oracle(scene.bodies);
    // Pairs that touch at the start are not asked about.
    const oracle::StepTruth one = oracle.judge(scene.step(), {}, kBoth);
    const oracle::StepTruth other = oracle.judge(back.step(), {}, kBoth);
    ASSERT_EQ(one.contacts.impact_vertices, other.contacts.impact_vertices) << text(scene);
    ASSERT_EQ(one.contacts.impact_edges, other.contacts.impact_edges) << text(scene);
    ASSERT_EQ(one.contacts.impact_triangles, other.contacts.impact_triangles) << text(scene);
    ASSERT_EQ(one.contacts.self_impact_vertices, other.contacts.self_impact_vertices);
    ASSERT_EQ(one.contacts.self_impact_edges, other.contacts.self_impact_edges);
  }
}

// A step without motion has the contacts of its frame.
TEST(StepTruth, StepWithoutMotionHasTheTruthOfTheFrame) {
  TriangleSource random(905);
  std::size_t contacts = 0;
  for (int round = 0; round < 200; ++round) {
    StepScene scene =
        round % 2 == 0 ? draw_small(random) : draw_step_scene(random, StepFamily::kDegenerate);
    scene.end = scene.start;
    oracle::Oracle frames(scene.bodies);
    oracle::StepOracle steps(scene.bodies);
    const ContactSet frame = frames.judge(scene.start.frame(), {}).surface;
    const oracle::StepTruth truth = steps.judge(scene.step(), frame.triangles, {});
    ASSERT_EQ(truth.contacts.impact_triangles, frame.triangles) << text(scene);
    ASSERT_EQ(truth.contacts.impact_triangles, StepBruteForce(scene).at_start()) << text(scene);
    ASSERT_EQ(truth.first.size(), frame.bodies.size());
    for (std::size_t i = 0; i < truth.first.size(); ++i) {
      ASSERT_EQ(truth.first[i].bodies, frame.bodies[i]);
      ASSERT_TRUE(truth.first[i].starts_in_contact);
      ASSERT_EQ(truth.first[i].latest, 0.0);
    }
    contacts += frame.triangles.size();
  }
  EXPECT_GT(contacts, 1000u);
}

TEST(StepTruth, OneOracleJudgesStepsInAnyOrder) {
  TriangleSource random(906);
  const StepScene one = draw_step_scene(random, StepFamily::kSlow);
  const StepScene back = reversed(one);
  oracle::Oracle frames(one.bodies);
  const auto at_start = [&](const StepScene& scene) {
    return frames.judge(scene.start.frame(), {}).surface.triangles;
  };
  oracle::StepOracle oracle(one.bodies);
  for (const StepScene* scene : {&one, &back, &one, &one, &back}) {
    oracle::StepOracle fresh(one.bodies);
    const oracle::StepTruth got = oracle.judge(scene->step(), at_start(*scene), kBoth);
    const oracle::StepTruth expected = fresh.judge(scene->step(), at_start(*scene), kBoth);
    EXPECT_EQ(got.contacts.impact_triangles, expected.contacts.impact_triangles);
    EXPECT_EQ(got.contacts.impact_edges, expected.contacts.impact_edges);
    EXPECT_EQ(got.contacts.self_impact_edges, expected.contacts.self_impact_edges);
  }
}

TEST(StepTruth, OnlyWantedKindsAreJudged) {
  TriangleSource random(907);
  StepScene scene = draw_step_scene(random, StepFamily::kWelded);
  oracle::StepOracle oracle(scene.bodies);
  const oracle::StepTruth own = oracle.judge(scene.step(), {}, {false, true});
  EXPECT_THAT(own.first, IsEmpty());
  EXPECT_THAT(own.contacts.impact_edges, IsEmpty());
  EXPECT_FALSE(own.contacts.self_impact_edges.empty());
  const oracle::StepTruth between = oracle.judge(scene.step(), {}, {true, false});
  EXPECT_FALSE(between.contacts.impact_edges.empty());
  EXPECT_THAT(between.contacts.self_impact_edges, IsEmpty());
  EXPECT_THAT(between.contacts.self_impact_vertices, IsEmpty());
}

/// Two triangles, of which the second moves by `by`.
StepScene two_triangles(const TriangleMesh& still, const TriangleMesh& moving, const Vec3& by) {
  std::vector<Vec3> last = moving.vertices;
  for (Vec3& v : last) v += by;
  return make_step_scene("two", {{"a", make_bare_shape(still)}, {"b", make_bare_shape(moving)}},
                         {still.vertices, moving.vertices}, {still.vertices, last});
}

oracle::StepTruth judged(const StepScene& scene) {
  oracle::Oracle frames(scene.bodies);
  oracle::StepOracle steps(scene.bodies);
  return steps.judge(scene.step(), frames.judge(scene.start.frame(), {}).surface.triangles, kBoth);
}

// Both triangles pierce each other, and no vertex and no edge ever touches.
TEST(StepTruth, PiercingAtTheStartIsContactWithoutElements) {
  const StepScene scene =
      two_triangles(triangle_mesh(Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)),
                    triangle_mesh(Vec3(0, 0, -4), Vec3(1, 0, 4), Vec3(-1, 0, 4)), Vec3(0, 0.5, 0));
  const oracle::StepTruth truth = judged(scene);
  EXPECT_THAT(truth.contacts.impact_triangles, ElementsAre(ElementPair{0, 1, 0, 0}));
  EXPECT_THAT(truth.contacts.impact_vertices, IsEmpty());
  EXPECT_THAT(truth.contacts.impact_edges, IsEmpty());
  ASSERT_THAT(truth.first, SizeIs(1));
  EXPECT_TRUE(truth.first[0].starts_in_contact);
}

TEST(StepTruth, FirstTimesByHand) {
  const TriangleMesh floor = triangle_mesh(Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0));
  const TriangleMesh tip = triangle_mesh(Vec3(0, 0, 1), Vec3(1, 0, 5), Vec3(-1, 0, 5));
  const auto first_time = [&](const Vec3& by) {
    return judged(two_triangles(floor, tip, by)).first;
  };
  EXPECT_THAT(first_time(Vec3(0, 0, 2)), IsEmpty());
  EXPECT_THAT(first_time(Vec3(0, 0, -0.999)), IsEmpty());
  for (const double depth : {1.0, 2.0, 3.0, 100.0}) {  // beyond 6 it has tunnelled
    const std::vector<FirstImpact> first = first_time(Vec3(0, 0, -depth));
    ASSERT_THAT(first, SizeIs(1));
    EXPECT_FALSE(first[0].starts_in_contact);
    EXPECT_LE(first[0].earliest, 1 / depth);
    EXPECT_GE(first[0].latest, 1 / depth);
  }
}

}  // namespace
}  // namespace contactcheck::test::step_truth
