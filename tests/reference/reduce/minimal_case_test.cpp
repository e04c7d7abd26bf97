#include "reference/reduce/minimal_case.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <limits>

#include "reference/scene/scene.h"
#include "reference/text/id_check.h"
#include "tests/reference/reduce/candidates.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::reduce {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

MinimalCase minimal_case(bool on_nodes) {
  MinimalCase out;
  out.id = "min-test";
  out.scene = "bunny-touch";
  out.place = "frame 7";
  out.detector = "libccd-gjk:iterations=5";
  out.library = "libccd 2.1";
  out.finding = {"triangle", "missed"};
  out.levels = {Level::kBody, Level::kTriangle};
  out.candidate = test::two_triangles({0, -0.1, 1, 1.0 / 3.0, 5e-324, 1e300, 2, 3, 1e-5,  //
                                       0.5, 0.7, -1, 1, 1, 1, -1.0 / 3.0, 4, 1e16});
  out.candidate.names = {"left \"one\"", "right"};
  out.candidate.on_nodes = on_nodes;
  return out;
}

TEST(NumberText, IsDecimalWhereThatIsShort) {
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(-2.0), "-2");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1.0 / 3.0), "0x1.5555555555555p-2");
}

TEST(NumberText, ReadsBackBitForBit) {
  for (const double x : {0.1, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max(), 1e22, -7e-9})
    EXPECT_EQ(std::strtod(number_text(x).c_str(), nullptr), x);
}

TEST(FamilyText, ReadsBackAsTheSameBodiesBitForBit) {
  for (const bool on_nodes : {false, true}) {
    const MinimalCase minimal = minimal_case(on_nodes);
    const test::Scratch scratch;
    const scene::Scene scene =
        scene::load_scene(scratch.write("min-test.json", family_text(minimal)));
    EXPECT_EQ(scene.id, "min-test");
    EXPECT_EQ(scene.frames, 1u);
    EXPECT_THAT(scene.levels, ElementsAre(Level::kBody, Level::kTriangle));
    EXPECT_EQ(scene.bodies[0].name, "left \"one\"");
    const Snapshot wanted = snapshot_of(minimal.candidate);
    for (std::size_t b = 0; b < 2; ++b) {
      EXPECT_EQ(content_hash(scene.bodies[b].shape->mesh),
                content_hash(wanted.bodies[b].shape->mesh));
      EXPECT_EQ(scene.bodies[b].shape->lattice.has_value(), on_nodes);
    }
    EXPECT_EQ(scene.recorded[0], wanted.nodes);
  }
}

// One mesh stays one, in the file and in the test that is printed.
TEST(MinimalCase, OfOneBodyHasOneMesh) {
  MinimalCase minimal = minimal_case(false);
  minimal.finding = {"self-vertex", "missed"};
  minimal.levels = {Level::kSelfVertex};
  minimal.candidate.names = {"hand"};
  minimal.candidate.meshes = {
      {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.25, 0.25, 0), Vec3(1, 1, 1)},
       {{0, 1, 2}, {0, 3, 4}}}};
  const test::Scratch scratch;
  const scene::Scene scene =
      scene::load_scene(scratch.write("min-test.json", family_text(minimal)));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].shape->mesh.triangles, minimal.candidate.meshes[0].triangles);
  EXPECT_THAT(scene.levels, ElementsAre(Level::kSelfVertex));

  ProbeVerdict verdict;
  verdict.levels[Level::kSelfVertex] = {1, 0, 0, 1, 0};
  judge::Disagreement& d = verdict.disagreements.emplace_back();
  d.level = "self-vertex";
  d.kind = "missed";
  d.pair = {0, 0, 0, 1};
  const CaseAnswers answers = answers_of(minimal, verdict);
  EXPECT_EQ(answers.exact,
            "triangle 0 of hand and triangle 1 of hand share more than their common corner");
  const std::string test = printed_test(minimal, answers, TestLanguage::kPython);
  EXPECT_THAT(test, HasSubstr("    vertices = [\n"));
  EXPECT_THAT(test, HasSubstr("    assert your_detector(vertices, triangles, 0, 1)\n"));
  EXPECT_THAT(test, HasSubstr("does it report triangles 0 and 1?"));
}

TEST(FamilyText, SaysWhereItIsFrom) {
  EXPECT_THAT(
      family_text(minimal_case(false)),
      HasSubstr("scene bunny-touch, frame 7, detector libccd-gjk:iterations=5 (libccd 2.1)"));
}

TEST(IdFrom, IsAnIdWhateverTheWords) {
  EXPECT_EQ(id_from("min-libccd-gjk:iterations=5-a b"), "min-libccd-gjk-iterations-5-a-b");
  for (const std::string& words :
       {std::string(100, 'x'), std::string("--a/b@1"), std::string("0x1p-3 m")})
    EXPECT_TRUE(text::is_id(id_from(words))) << words;
}

}  // namespace
}  // namespace contactcheck::reduce
