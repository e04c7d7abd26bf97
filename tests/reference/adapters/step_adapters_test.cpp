// Embree's and FCL's detectors of contact within steps.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "tests/reference/adapters/adapter_world.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::test::step_adapters {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char *kEmbree = "embree-swept", *kFcl = "fcl-ccd";

std::unique_ptr<Detector> prepared(const std::string& name, const std::vector<Body>& bodies) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  adapters::register_reference_detectors(catalog);
  std::unique_ptr<Detector> detector = catalog.make(catalog.parse(name));
  detector->prepare(bodies);
  return detector;
}

/// To all questions of steps that it answers, one after the other. As the interface says, the
/// step's states live longer than the questions; the step does not.
ContactSet answer(Detector& detector, const StepScene& scene) {
  detector.update_step(scene.step());
  ContactSet out;
  for (const Question question : {Question::kImpacts, Question::kSelfImpacts})
    if (detector.semantics().answers(question)) detector.query(question, out);
  out.canonicalize();
  return out;
}

/// Of a fresh detector.
ContactSet answer(const std::string& name, const StepScene& scene) {
  return answer(*prepared(name, scene.bodies), scene);
}

std::vector<double> times(const ContactSet& set) {
  std::vector<double> out;
  for (const BodyImpact& impact : set.impacts) out.push_back(impact.time.value_or(-1));
  return out;
}

/// The first list that differs; empty: none does.
std::string difference(const ContactSet& got, const ContactSet& expected) {
  if (got.impact_triangles != expected.impact_triangles) return "triangles";
  if (got.impact_vertices != expected.impact_vertices) return "vertices";
  if (got.impact_edges != expected.impact_edges) return "edges";
  if (got.self_impact_vertices != expected.self_impact_vertices) return "own vertices";
  if (got.self_impact_edges != expected.self_impact_edges) return "own edges";
  if (got.impacts.size() != expected.impacts.size()) return "bodies";
  for (std::size_t i = 0; i < got.impacts.size(); ++i)
    if (got.impacts[i].bodies != expected.impacts[i].bodies) return "bodies";
  return times(got) == times(expected) ? "" : "times";
}

TEST(EmbreeSwept, ClaimsAllLevelsOfStepsAndIsExact) {
  const Semantics semantics = make_detector(kEmbree)->semantics();
  for (const Level level : kLevels) EXPECT_EQ(semantics.claims(level), is_impact(level));
  EXPECT_THAT(semantics.questions, ElementsAre(Question::kImpacts, Question::kSelfImpacts));
  EXPECT_TRUE(semantics.exact);
  EXPECT_THROW(make_detector(kEmbree)->update({}), std::logic_error);
}

class EmbreeSweptFamilies : public ::testing::TestWithParam<StepFamily> {};

INSTANTIATE_TEST_SUITE_P(All, EmbreeSweptFamilies, ::testing::ValuesIn(kStepFamilies),
                         [](const auto& parameter) {
                           std::string name = name_of(parameter.param);
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST_P(EmbreeSweptFamilies, GiveTheAnswersOfSweptAabb) {
  TriangleSource random(920 + static_cast<std::uint64_t>(GetParam()));
  std::size_t contacts = 0;
  for (int round = 0; round < 15; ++round) {
    const StepScene scene = draw_step_scene(random, GetParam());
    const ContactSet expected = answer("swept-aabb", scene);
    ASSERT_EQ(difference(answer(kEmbree, scene), expected), "") << scene.name << " " << round;
    contacts += expected.impact_triangles.size();
  }
  EXPECT_GT(contacts, 50u);
}

// Boxes are of floats: a contact by one unit in the last place of a double is far below them.
TEST(EmbreeSwept, ContactByAHairIsThatOfSweptAabb) {
  const TriangleMesh box = box_mesh(Vec3(-1, -0.75, -0.5), Vec3(1, 0.75, 0.5), 1);
  const std::vector<Body> bodies = {make_body("a", box, {2, 2, 2}), make_body("b", box, {1, 2, 1})};
  TriangleSource random(940);
  std::size_t meet = 0, steps = 0;
  for (int round = 0; round < 60; ++round) {
    Graze graze;
    graze.turned_at_start = graze.turned_at_end = draw_rotation(random);
    graze.at_start = random.point(Vec3::Zero(), 1.0);
    graze.at_end = graze.at_start + random.point(Vec3::Zero(), round % 2 == 0 ? 0.0 : 2000.0);
    (random.below(2) == 0 ? graze.apart_at_start : graze.apart_at_end) = 1.0;
    const double unit = round % 2 == 0 ? 0x1p-53 : 0x1p-43;
    const StepScene scene = grazing(bodies, graze, unit * (random.below(9) - 4));
    const ContactSet expected = answer("swept-aabb", scene);
    ASSERT_EQ(difference(answer(kEmbree, scene), expected), "") << round;
    ++steps;
    meet += expected.impacts.size();
  }
  EXPECT_GT(meet, steps / 5);
  EXPECT_LT(meet, steps - steps / 5);
}

/// The bodies of a scene at several moments, any two of which make a step.
struct Moments {
  std::vector<Body> bodies;
  std::vector<FrameData> frames;
  StepScene step(std::size_t from, std::size_t to) const {
    return {"step", bodies, frames[from], frames[to]};
  }
};

/// Two balls that meet between all moments but the first two and the last two, which are far apart:
/// there nothing needs to be looked at.
Moments balls_that_meet_and_part() {
  const TriangleMesh ball = sphere_mesh(Vec3::Zero(), 1.0, 1);
  Moments out{{{"a", make_bare_shape(ball)}, {"b", make_bare_shape(ball)}}, {}};
  for (const double gap : {9.0, 7.0, 0.5, 0.1, -1.0, 7.5, 9.5})
    out.frames.push_back(make_frame(
        out.bodies, {ball.vertices, rest_nodes_at(*out.bodies[1].shape,
                                                  Vec3(2.0 + gap, 0.17, 0.06 + 0.01 * gap))}));
  return out;
}

constexpr std::size_t kStepsInARow[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}};
constexpr std::size_t kStepsInAnyOrder[][2] = {{2, 3}, {3, 4}, {3, 4}, {0, 1}, {2, 3}, {4, 3},
                                               {3, 4}, {4, 5}, {1, 2}, {5, 6}, {4, 4}, {2, 3}};

template <std::size_t count>
void expect_answers_of_fresh_detectors(const char* name, const std::size_t (&steps)[count][2]) {
  const Moments moments = balls_that_meet_and_part();
  const auto detector = prepared(name, moments.bodies);
  std::size_t contacts = 0;
  for (const auto& [from, to] : steps) {
    const StepScene step = moments.step(from, to);
    const ContactSet fresh = answer(name, step);
    EXPECT_EQ(difference(answer(*detector, step), fresh), "") << from << " to " << to;
    contacts += fresh.impact_triangles.size();
  }
  EXPECT_GT(contacts, 10u);
}

TEST(EmbreeSwept, StepsInARowGiveTheAnswersOfFreshDetectors) {
  expect_answers_of_fresh_detectors(kEmbree, kStepsInARow);
}
TEST(EmbreeSwept, StepsInAnyOrderGiveTheAnswersOfFreshDetectors) {
  expect_answers_of_fresh_detectors(kEmbree, kStepsInAnyOrder);
}

// A body that meets no other is moved for the question about itself alone, when the step is gone.
TEST(EmbreeSwept, BodyThatMeetsNoOtherIsTestedWithItself) {
  TriangleSource random(941);
  StepScene scene = draw_step_scene(random, StepFamily::kFolding);
  scene.bodies.resize(1);
  for (FrameData* data : {&scene.start, &scene.end})
    data->nodes.resize(1), data->vertices.resize(1);
  const ContactSet expected = answer("swept-aabb", scene);
  EXPECT_GT(expected.self_impact_edges.size(), 5u);
  EXPECT_EQ(difference(answer(kEmbree, scene), expected), "");
}

TEST(FclContinuous, ClaimsTrianglesAndBodiesWithoutExactness) {
  const Semantics semantics = make_detector(kFcl)->semantics();
  EXPECT_THAT(semantics.levels, ElementsAre(Level::kImpactTriangle, Level::kImpact));
  EXPECT_THAT(semantics.questions, ElementsAre(Question::kImpacts));
  EXPECT_FALSE(semantics.exact);
  EXPECT_THROW(make_detector(kFcl)->update({}), std::logic_error);
}

TEST(FclContinuous, StepsInARowGiveTheAnswersOfFreshDetectors) {
  expect_answers_of_fresh_detectors(kFcl, kStepsInARow);
}
TEST(FclContinuous, StepsInAnyOrderGiveTheAnswersOfFreshDetectors) {
  expect_answers_of_fresh_detectors(kFcl, kStepsInAnyOrder);
}

/// Two triangles with edges of about 10 cm, of which one falls: a corner onto the middle of the
/// other, or the middle of an edge onto that of an edge. What FCL calls inside reaches beyond a
/// triangle of this size by millimetres: nothing comes down near a border.
StepScene draw_fall(TriangleSource& random, bool corner) {
  const auto near = [&](double x, double y, double z) {
    return random.point(Vec3(x, y, z), 0.004);
  };
  const double height = 0.02 + 0.01 * random.unit();
  const TriangleMesh still =
      corner ? triangle_mesh(near(-0.06, -0.05, 0), near(0.06, -0.05, 0), near(0, 0.06, 0))
             : triangle_mesh(near(-0.05, 0, 0), near(0.05, 0, 0), near(0, 0, -0.1));
  const TriangleMesh moving =
      corner
          ? triangle_mesh(near(0, -0.01, height), near(0.05, 0, height + 0.1),
                          near(-0.05, 0, height + 0.1))
          : triangle_mesh(near(0, -0.05, height), near(0, 0.05, height), near(0, 0, height + 0.1));
  std::vector<Vec3> last = moving.vertices;
  for (Vec3& v : last) v.z() -= random.below(4) == 0 ? 0.3 * height : height + 0.03;
  return make_step_scene("fall", {{"a", make_bare_shape(still)}, {"b", make_bare_shape(moving)}},
                         {still.vertices, moving.vertices}, {still.vertices, last});
}

TEST(FclContinuous, PlainCrossingsOfTenCentimetresAreFoundWithTheirTimes) {
  TriangleSource random(942);
  std::size_t meet = 0, apart = 0;
  for (int round = 0; round < 500; ++round) {
    const StepScene scene = draw_fall(random, round % 2 == 0);
    const ContactSet got = answer(kFcl, scene), truth = answer("swept-aabb", scene);
    ASSERT_EQ(got.impact_triangles, truth.impact_triangles) << round;
    ASSERT_EQ(got.impacts.size(), truth.impacts.size()) << round;
    EXPECT_THAT(got.impact_vertices, IsEmpty());
    EXPECT_THAT(got.impact_edges, IsEmpty());
    (truth.impacts.empty() ? apart : meet) += 1;
    if (truth.impacts.empty()) continue;
    ASSERT_TRUE(got.impacts[0].time.has_value());
    EXPECT_NEAR(*got.impacts[0].time, *truth.impacts[0].time, 1e-6) << round;
  }
  EXPECT_GT(meet, 200u);
  EXPECT_GT(apart, 20u);
}

TEST(FclContinuous, TriangleIndicesAreThoseOfTheirBodies) {
  const TriangleMesh tip = triangle_mesh(Vec3(0, 0, 0.1), Vec3(0.1, 0, 0.5), Vec3(-0.1, 0, 0.5));
  const TriangleMesh floor = box_mesh(Vec3(-0.5, -0.4, -0.3), Vec3(0.5, 0.4, 0), 2);
  std::vector<Vec3> last = tip.vertices;
  for (Vec3& v : last) v += Vec3(0.07, 0.03, -0.2);
  const std::vector<Body> bodies = {{"floor", make_bare_shape(floor)},
                                    {"tip", make_bare_shape(tip)}};
  const StepScene scene =
      make_step_scene("tip", bodies, {floor.vertices, tip.vertices}, {floor.vertices, last});
  const ContactSet got = answer(kFcl, scene);
  EXPECT_EQ(got.impact_triangles, answer("swept-aabb", scene).impact_triangles);
  EXPECT_THAT(got.impacts, SizeIs(1));
}

}  // namespace
}  // namespace contactcheck::test::step_adapters
