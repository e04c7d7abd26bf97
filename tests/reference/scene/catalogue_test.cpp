// The fixtures that come with contactcheck, each scene as a test of its own.
#include "reference/scene/catalogue.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "reference/scene/scene.h"
#include "reference/scene/suite_file.h"
#include "reference/text/file_text.h"
#include "reference/text/json_value.h"
#include "tests/reference/scene/installed.h"

namespace contactcheck::scene {

// Names the test in place of its parameter's bytes.
void PrintTo(const CatalogueEntry& entry, std::ostream* out) { *out << entry.id; }

namespace {

using test::data_installed;
using test::Environment;
using test::Scratch;
using test::sentence_of;

const std::filesystem::path kFixtures = CONTACTCHECK_FIXTURES;

// Scenes that measure speed: hardly moving, of any size.
bool measures_speed(const std::string& id) {
  return id.starts_with("scaling-") || id == "near-miss" || id == "contact" || id == "small-pair" ||
         id == "coincident";
}

std::vector<CatalogueEntry> speed_scenes() {
  std::vector<CatalogueEntry> out;
  for (const CatalogueEntry& entry : list_scenes(kFixtures))
    if (measures_speed(entry.id)) out.push_back(entry);
  return out;
}

// The scenes that are simulated, or those that follow a script.
std::vector<CatalogueEntry> scenes_that_are(bool simulated) {
  std::vector<CatalogueEntry> out;
  for (const CatalogueEntry& entry : list_scenes(kFixtures)) {
    if (measures_speed(entry.id) || entry.id.starts_with("step-")) continue;
    const text::JsonValue scene =
        text::parse_json(text::read_file_bytes(entry.file, "scene file"), entry.id);
    if (scene.find("sweep") != nullptr) continue;  // poses, not a motion
    if ((scene.find("simulation") != nullptr) == simulated) out.push_back(entry);
  }
  return out;
}

std::string named_entry(const ::testing::TestParamInfo<CatalogueEntry>& test) {
  std::string name = test.param.id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class FixtureScene : public ::testing::TestWithParam<CatalogueEntry> {};

TEST_P(FixtureScene, LoadsAndMovesFinitely) {
  if (!data_installed()) GTEST_SKIP() << "install libcgal-demo and povray-examples";
  const Scene scene = load_scene(GetParam().file);
  EXPECT_EQ(scene.id, GetParam().id);
  const bool costly = scene.id == "torus-fine" || scene.id == "nested";
  const bool self = scene.id.starts_with("self-");
  if (self) {
    EXPECT_GE(scene.frames, 8u);
    EXPECT_TRUE(scene.judges(Level::kSelf));
  } else {
    EXPECT_EQ(scene.frames, costly ? 30u : 60u);
    EXPECT_TRUE(scene.judges(Level::kTriangle));
  }
  std::size_t triangles = 0;
  for (const Body& body : scene.bodies) triangles += body.shape->mesh.triangles.size();
  EXPECT_GE(triangles, 5000u);
  EXPECT_LE(triangles, self ? 150000u : 60000u);
  for (std::size_t frame = 0; frame < scene.frames; frame += 5) {
    for (const std::vector<Vec3>& nodes : scene.nodes_of_frame(frame)) {
      EXPECT_TRUE(std::all_of(nodes.begin(), nodes.end(),
                              [](const Vec3& p) { return p.allFinite() && p.norm() < 10.0; }));
    }
  }
}

TEST_P(FixtureScene, DeformsEveryBodyInItsLattice) {
  if (!data_installed()) GTEST_SKIP() << "install libcgal-demo and povray-examples";
  const Scene scene = load_scene(GetParam().file);
  const std::vector<std::vector<Vec3>> start = scene.nodes_of_frame(0),
                                       middle = scene.nodes_of_frame(scene.frames / 2);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    ASSERT_TRUE(scene.bodies[b].shape->lattice.has_value());
    // Of the paper's size, but where a body folds: there as its fold needs it.
    const bool self = scene.id.starts_with("self-");
    EXPECT_GE(scene.bodies[b].shape->lattice->cells.size(), self ? 2u : 90u);
    EXPECT_LE(scene.bodies[b].shape->lattice->cells.size(), self ? 420u : 230u);
    // A rigid motion keeps the distance of two nodes; these change by centimetres.
    double largest = 0.0;
    for (std::size_t n = 1; n < start[b].size(); ++n) {
      largest = std::max(largest, std::abs((start[b][n] - start[b][0]).norm() -
                                           (middle[b][n] - middle[b][0]).norm()));
    }
    EXPECT_GT(largest, 0.03) << scene.bodies[b].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, FixtureScene, ::testing::ValuesIn(scenes_that_are(false)),
                         named_entry);

class SpeedFixture : public ::testing::TestWithParam<CatalogueEntry> {};

TEST_P(SpeedFixture, LoadsAndMovesALittleInSixCellsASide) {
  if (!data_installed()) GTEST_SKIP() << "install libcgal-demo and povray-examples";
  const Scene scene = load_scene(GetParam().file);
  EXPECT_EQ(scene.id, GetParam().id);
  EXPECT_LE(scene.frames, 20u);
  EXPECT_TRUE(scene.judges(Level::kTriangle));
  const auto start = scene.nodes_of_frame(0), last = scene.nodes_of_frame(scene.frames - 1);
  EXPECT_TRUE(start[0] != last[0]);  // late copies do not move within the scene
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (const auto& lines : scene.bodies[b].shape->lattice.value().lines)
      EXPECT_EQ(lines.size(), 7u);
    EXPECT_TRUE(std::all_of(last[b].begin(), last[b].end(),
                            [](const Vec3& p) { return p.allFinite() && p.norm() < 20.0; }));
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, SpeedFixture, ::testing::ValuesIn(speed_scenes()), named_entry);

// Those of the suite `continuous`: few frames, since every step is judged.
std::vector<CatalogueEntry> step_scenes() {
  std::vector<CatalogueEntry> out;
  for (const CatalogueEntry& entry : list_scenes(kFixtures))
    if (entry.id.starts_with("step-")) out.push_back(entry);
  return out;
}

class StepFixture : public ::testing::TestWithParam<CatalogueEntry> {};

TEST_P(StepFixture, LoadsAndIsJudgedBetweenFrames) {
  if (!data_installed()) GTEST_SKIP() << "install libcgal-demo and povray-examples";
  const Scene scene = load_scene(GetParam().file);
  EXPECT_EQ(scene.id, GetParam().id);
  EXPECT_GE(scene.frames, 4u);
  EXPECT_LE(scene.frames, 12u);
  EXPECT_TRUE(any_impact(scene.levels));
  EXPECT_EQ(scene.judges(Level::kImpactSelfVf), scene.bodies.size() == 1);
  std::size_t triangles = 0;
  for (const Body& body : scene.bodies) triangles += body.shape->mesh.triangles.size();
  EXPECT_GE(triangles, 5000u);
  EXPECT_LE(triangles, 151'000u);
}

INSTANTIATE_TEST_SUITE_P(Fixtures, StepFixture, ::testing::ValuesIn(step_scenes()), named_entry);

class SimulatedFixture : public ::testing::TestWithParam<CatalogueEntry> {};

TEST_P(SimulatedFixture, LoadsWithAFiniteStart) {
  if (!data_installed()) GTEST_SKIP() << "install libcgal-demo and povray-examples";
  const Scene scene = load_scene(GetParam().file);
  EXPECT_EQ(scene.id, GetParam().id);
  ASSERT_NE(scene.simulation(), nullptr);
  EXPECT_TRUE(scene.judges(Level::kTriangle));
  // Long enough to fall and to hit; at full resolution no longer than that, else until rest.
  const bool full = scene.id.ends_with("-full");
  EXPECT_NEAR(scene.time_of(scene.frames), full ? 2.0 : 4.0, 1e-12);
  for (const std::vector<Vec3>& nodes : scene.nodes_at(0.0)) {
    EXPECT_TRUE(std::all_of(nodes.begin(), nodes.end(),
                            [](const Vec3& p) { return p.allFinite() && p.norm() < 10.0; }));
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, SimulatedFixture, ::testing::ValuesIn(scenes_that_are(true)),
                         named_entry);

TEST(Catalogue, HasTheScenesOfTheDefaultSuite) {
  const Suite suite = load_suite(kFixtures / "suites" / "default.json");
  EXPECT_GE(suite.scenes.size(), 6u);
  for (const SuiteScene& scene : suite.scenes) {
    const std::string& id = scene.id;
    EXPECT_EQ(find_scene(id, kFixtures), kFixtures / "scenes" / (id + ".json"));
  }
}

TEST(Catalogue, NoIdIsBothSuiteAndScene) {
  std::set<std::string> ids;
  const std::vector<CatalogueEntry> scenes = list_scenes(kFixtures),
                                    suites = list_suites(kFixtures);
  for (const CatalogueEntry& entry : scenes) ids.insert(entry.id);
  for (const CatalogueEntry& entry : suites) ids.insert(entry.id);
  EXPECT_EQ(ids.size(), scenes.size() + suites.size());
  EXPECT_GE(suites.size(), 1u);
}

TEST(Catalogue, FindsSuitesScenesAndFiles) {
  const Scratch scratch;
  EXPECT_EQ(find_target("default", kFixtures).kind, TargetKind::kSuite);
  EXPECT_EQ(find_target("letters", kFixtures).kind, TargetKind::kScene);
  EXPECT_EQ(find_target(scratch.write("a.json", R"({"bodies": []})").string(), kFixtures).kind,
            TargetKind::kScene);
  EXPECT_EQ(find_target(scratch.write("b.json", R"({"scenes": []})").string(), kFixtures).kind,
            TargetKind::kSuite);
  EXPECT_EQ(find_target(scratch.write("c.ccr", "x").string(), kFixtures).kind,
            TargetKind::kRecording);
}

TEST(Catalogue, UnknownNamesLeadToThoseThatAreNear) {
  const Scratch scratch;
  scratch.write("scenes/one.json", "{}");
  scratch.write("scenes/two.json", "{}");
  scratch.write("suites/all.json", "{}");
  EXPECT_EQ(sentence_of([&] { find_target("tow", scratch.folder()); }),
            "\"tow\" is no suite, scene, family of hard cases, .json or .ccr file; did you mean "
            "two? `contactcheck list` names all.");
  EXPECT_EQ(sentence_of([&] { find_target("al", scratch.folder()); }),
            "\"al\" is no suite, scene, family of hard cases, .json or .ccr file; `contactcheck "
            "list` names all.");
  EXPECT_EQ(sentence_of([&] { find_target("three.json", scratch.folder()); }),
            "\"three.json\" does not exist.");
  EXPECT_EQ(sentence_of([&] { find_scene("once", scratch.folder()); }),
            "there is no scene \"once\"; did you mean one? `contactcheck list` names all.");
}

TEST(Catalogue, IdMustBeTheFilesName) {
  const Scratch scratch;
  const auto file = scratch.write("scenes/one.json", R"({"id": "two"})");
  EXPECT_EQ(sentence_of([&] { list_scenes(scratch.folder()); }),
            "scene file \"" + file.string() +
                "\": id is \"two\"; it must be the file's name without its extension, \"one\".");
}

TEST(Catalogue, FolderFollowsTheEnvironment) {
  {
    const Environment own("CONTACTCHECK_FIXTURES", "/elsewhere");
    EXPECT_EQ(fixtures_directory(), "/elsewhere");
    EXPECT_EQ(sentence_of([] { list_suites(fixtures_directory()); }),
              "folder \"/elsewhere/suites\" with files of the kind suite does not exist; "
              "$CONTACTCHECK_FIXTURES "
              "says where fixtures are.");
  }
  const Environment empty("CONTACTCHECK_FIXTURES", "");
  EXPECT_EQ(fixtures_directory(), kFixtures);
}

}  // namespace
}  // namespace contactcheck::scene
