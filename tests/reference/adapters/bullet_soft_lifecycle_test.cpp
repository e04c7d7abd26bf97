// What both detectors made of Bullet's soft bodies promise alike.
#include <gmock/gmock.h>

#include <thread>

#include "core/types/check.h"
#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

World two_soft_spheres() {
  return World({sphere_mesh(Vec3(0, 0, 0), 1, 3), sphere_mesh(Vec3(1.53, 0.31, 0.17), 0.9, 3)});
}

/// All that a detector says of a frame, to be compared.
struct Answer {
  std::vector<BodyPair> bodies;
  std::vector<NearPair> near;
  std::vector<double> depths;
  bool operator==(const Answer&) const = default;
};

Answer answer(Detector& detector) {
  const ContactSet bodies = ask(detector, Question::kBody);
  const ContactSet own = ask(detector, detector.semantics().questions.front());
  Answer out{bodies.bodies, own.near, {}};
  for (const VertexContact& c : own.vertex_contacts) out.depths.push_back(c.depth);
  std::sort(out.depths.begin(), out.depths.end());
  return out;
}

class BulletSoft : public ::testing::TestWithParam<const char*> {
 protected:
  /// With a margin at which the worlds here have many vertices near faces.
  static std::string name() { return std::string(GetParam()) + ":margin=0.02"; }
};

INSTANTIATE_TEST_SUITE_P(Both, BulletSoft, ::testing::Values("bullet-vf", "bullet-cl"),
                         [](const auto& parameter) {
                           return std::string(parameter.param) == "bullet-vf" ? "vf" : "cl";
                         });

TEST_P(BulletSoft, OptionsAtTheirDefaultsAreLeftOut) {
  DetectorCatalog catalog;
  adapters::register_reference_detectors(catalog);
  const std::string id = GetParam();
  EXPECT_EQ(catalog.parse(id + ":margin=0.001,scale=0").name, id);
  EXPECT_EQ(catalog.parse(id + ":scale=100,margin=0.01").name, id + ":margin=0.01,scale=100");
  EXPECT_THROW(catalog.parse(id + ":margin=-0.1"), InputError);
  EXPECT_THROW(catalog.parse(id + ":margin=1.5"), InputError);
  EXPECT_THROW(catalog.parse(id + ":scale=-1"), InputError);
}

TEST_P(BulletSoft, IsFedInSinglePrecision) {
  const Semantics semantics = make_detector(std::string(GetParam()) + ":scale=8")->semantics();
  EXPECT_EQ(semantics.precision, Precision::kSingle);
  EXPECT_EQ(semantics.scale, 8.0);
  EXPECT_FALSE(semantics.closed);
  EXPECT_TRUE(make_detector(GetParam())->needs_vertices());
}

TEST_P(BulletSoft, ApartIsNoContactAndTogetherIs) {
  World world = two_soft_spheres();
  const auto detector = prepared(name(), world);
  EXPECT_THAT(answer(*detector).bodies, ElementsAre(BodyPair{0, 1}));
  shift(world, 1, Vec3(0.5, 0.5, 0.5));
  detector->update(world.frame());
  EXPECT_THAT(answer(*detector).bodies, IsEmpty());
}

TEST_P(BulletSoft, RepeatedQueriesAndUpdatesGiveTheSameAnswer) {
  const World world = two_soft_spheres();
  const auto detector = prepared(name(), world);
  const Answer first = answer(*detector);
  EXPECT_EQ(answer(*detector), first);
  detector->update(world.frame());
  EXPECT_EQ(answer(*detector), first);
  EXPECT_FALSE(first.bodies.empty());
}

TEST_P(BulletSoft, FramesBeforeLeaveNoTrace) {
  const World start = two_soft_spheres();
  const auto moved = prepared(name(), start);
  const Answer before = answer(*moved);
  World away = start;
  for (const Vec3& by : {Vec3(30, -20, 10), Vec3(-900, 4, 4), Vec3(870.2, 16, -14)}) {
    shift(away, 1, by);
    moved->update(away.frame());
    EXPECT_EQ(answer(*moved), answer(*prepared(name(), away)));
  }
  moved->update(start.frame());
  EXPECT_EQ(answer(*moved), before);
}

TEST_P(BulletSoft, PrepareAgainForgetsTheFirstScene) {
  const World first({sphere_mesh(Vec3(0, 0, 0), 1e-3, 3), sphere_mesh(Vec3(0, 0, 0), 1, 2),
                     sphere_mesh(Vec3(0, 0, 0), 1, 2)});
  const World second = two_soft_spheres();
  const auto detector = prepared(name(), first);
  EXPECT_EQ(detector->semantics().scale, 512.0);
  detector->prepare(second.bodies);
  detector->update(second.frame());
  EXPECT_EQ(answer(*detector), answer(*prepared(name(), second)));
  EXPECT_EQ(detector->semantics().scale, 1.0);
}

TEST_P(BulletSoft, EmptySceneAndOneBodyAreAnswered) {
  EXPECT_THAT(answer(*prepared(name(), World({}))).bodies, IsEmpty());
  const TriangleMesh sphere = sphere_mesh(Vec3(0, 0, 0), 1, 2);
  EXPECT_THAT(answer(*prepared(name(), World({sphere}))).bodies, IsEmpty());
}

TEST_P(BulletSoft, QueryAppendsToWhatIsThere) {
  ContactSet out;
  out.bodies.push_back({7, 8});
  prepared(name(), two_soft_spheres())->query(Question::kBody, out);
  EXPECT_THAT(out.bodies, ElementsAre(BodyPair{7, 8}, BodyPair{0, 1}));
}

TEST_P(BulletSoft, BothQuestionsAgreeOnManyBodies) {
  std::vector<TriangleMesh> meshes;
  for (int i = 0; i < 12; ++i)
    meshes.push_back(sphere_mesh(Vec3(0.9 * (i % 3), 0.95 * (i / 3 % 2), 1.05 * (i / 6)), 0.5, 3));
  const auto detector = prepared(name(), World(meshes));
  const ContactSet own = ask(*detector, detector->semantics().questions.front());
  EXPECT_EQ(ask(*detector, Question::kBody).bodies, own.bodies);
  EXPECT_GT(own.bodies.size(), 5u);
  EXPECT_LT(own.bodies.size(), 66u);
}

TEST_P(BulletSoft, CoordinateBeyondFloatsIsRefused) {
  World world = two_soft_spheres();
  const auto detector = prepared(name(), world);
  world.vertices[1][5].y() = 1e300;
  EXPECT_THROW(detector->update(world.frame()), RefusedInput);
  world.vertices[1][5].y() = 1e38;  // finite, but not at scale 100
  EXPECT_NO_THROW(prepared(name() + ",scale=1", world));
  EXPECT_THROW(prepared(name() + ",scale=100", world), RefusedInput);
  TriangleMesh far = sphere_mesh(Vec3(0, 0, 0), 1, 1);
  far.vertices[3].x() = -1e300;
  try {
    prepared(name(), World({far}));
    ADD_FAILURE() << "prepare took it";
  } catch (const RefusedInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("not finite in single precision"));
  }
}

TEST_P(BulletSoft, TwoDetectorsWorkInTwoThreads) {
  const World start = two_soft_spheres();
  const auto run = [&](std::vector<Answer>& answers) {
    World world = start;
    const auto detector = prepared(name(), world);
    for (int step = 0; step < 20; ++step) {
      shift(world, 1, Vec3(0.02, -0.01, 0.005));
      detector->update(world.frame());
      answers.push_back(answer(*detector));
    }
  };
  std::vector<Answer> alone, one, two;
  run(alone);
  std::thread first([&] { run(one); }), second([&] { run(two); });
  first.join();
  second.join();
  EXPECT_EQ(one, alone);
  EXPECT_EQ(two, alone);
}

TEST(BulletVersion, IsAmongTheLibraries) {
  EXPECT_THAT(adapters::library_versions().at("bullet"),
              ::testing::MatchesRegex("3\\.[0-9]+ float"));
}

}  // namespace
}  // namespace contactcheck::test
