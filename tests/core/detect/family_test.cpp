// Every member of the family against brute force over all pairs of triangles.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::prepared;
using test::Scene;
using test::true_pairs;

struct JudgedFamilyScene {
  Scene scene;
  std::vector<std::vector<ElementPair>> truth;  // per frame
};

// Made once: brute force is the expensive part.
const std::vector<JudgedFamilyScene>& judged_family_scenes() {
  static const std::vector<JudgedFamilyScene> scenes = [] {
    std::vector<Scene> all;
    std::uint64_t seed = 100;
    for (double strength : {0.0, 0.3, 1.0})
      for (int variant = 0; variant < 3; ++variant)
        all.push_back(test::approach({++seed, strength}));
    all.push_back(test::three_bodies({++seed, 0.3}));
    all.push_back(test::exact_boxes(Vec3::Zero()));
    std::vector<JudgedFamilyScene> judged;
    for (Scene& scene : all) {
      judged.push_back({std::move(scene), {}});
      for (const test::FrameData& frame : judged.back().scene.frames)
        judged.back().truth.push_back(true_pairs(judged.back().scene, frame));
    }
    return judged;
  }();
  return scenes;
}

// Frames that differ from the truth, over all scenes.
int wrong_frames(const std::string& name) {
  int wrong = 0;
  for (const JudgedFamilyScene& judged : judged_family_scenes()) {
    const auto detector = prepared(name, judged.scene);
    for (std::size_t f = 0; f < judged.truth.size(); ++f)
      wrong += answer(*detector, judged.scene.frames[f]).triangles != judged.truth[f];
  }
  return wrong;
}

TEST(JudgedScenes, HaveFramesApartTouchingAndDeepInside) {
  int frames = 0, with_contact = 0;
  std::size_t most = 0;
  for (const JudgedFamilyScene& judged : judged_family_scenes())
    for (const auto& truth : judged.truth) {
      ++frames;
      with_contact += !truth.empty();
      most = std::max(most, truth.size());
    }
  EXPECT_GT(with_contact, frames / 2);
  EXPECT_LT(with_contact, frames * 9 / 10);
  EXPECT_GT(most, 100u);
}

class EveryMember : public ::testing::TestWithParam<std::string> {};

std::string printable(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Family, EveryMember, ::testing::ValuesIn(test::family()), printable);

TEST_P(EveryMember, WithTrianglesAndSafeBoundsEqualsBruteForce) {
  EXPECT_EQ(wrong_frames(GetParam() + "+tri"), 0);
}

TEST_P(EveryMember, IsRightForEveryHashCellAndTable) {
  for (const char* options : {":cell=0.01", ":cell=100", ":cell=0.3,table=7", ":table=1"})
    EXPECT_EQ(wrong_frames(GetParam() + "+tri" + options), 0) << options;
}

TEST(SphereLevels, OfAnyNumberAndWidthEqualBruteForce) {
  for (const char* name :
       {"ffd-aabb-sphere2+tri:spheres=1", "ffd-aabb-sphere2+tri:spheres=1000",
        "ffd-aabb-sphereN+tri:levels=1", "ffd-aabb-sphereN+tri:levels=5,spheres=2",
        "ffd-aabb-sphereN+tri:levels=8,spheres=64"})
    EXPECT_EQ(wrong_frames(name), 0) << name;
}

TEST(SphereRadius, LargerThanNeededEqualsBruteForceAndSmallerDoesNot) {
  for (const std::string id :
       {"ffd-aabb-sphere+tri", "ffd-aabb-sphere2+tri", "ffd-aabb-sphereN+tri"}) {
    for (const char* larger : {":radius=1.25", ":radius=4"})
      EXPECT_EQ(wrong_frames(id + larger), 0) << id << larger;
    EXPECT_GT(wrong_frames(id + ":radius=0.25"), 0) << id;
  }
}

TEST_P(EveryMember, OfThePaperWithTrianglesNeverInventsAPair) {
  const std::string name = GetParam() + "+tri:bounds=paper";
  std::size_t reported = 0, truth = 0;
  for (const JudgedFamilyScene& judged : judged_family_scenes()) {
    const auto detector = prepared(name, judged.scene);
    for (std::size_t f = 0; f < judged.truth.size(); ++f) {
      const auto found = answer(*detector, judged.scene.frames[f]).triangles;
      EXPECT_TRUE(std::includes(judged.truth[f].begin(), judged.truth[f].end(), found.begin(),
                                found.end()));
      reported += found.size();
      truth += judged.truth[f].size();
    }
  }
  // It finds much and, under strong deformation, not all: the reason for the reading `safe`.
  EXPECT_GT(reported, truth / 4);
  EXPECT_LT(reported, truth);
}

TEST_P(EveryMember, AnswersTheBodyQuestionAsTheFullOne) {
  int touching = 0, apart = 0;
  for (const char* variant :
       {":bounds=paper", ":bounds=safe", "+tri:bounds=paper", "+tri:bounds=safe"}) {
    for (const JudgedFamilyScene& judged : judged_family_scenes()) {
      const auto detector = prepared(GetParam() + variant, judged.scene);
      for (const test::FrameData& frame : judged.scene.frames) {
        const ContactSet full = answer(*detector, frame);
        const ContactSet boolean = answer(*detector, frame, Question::kBody);
        EXPECT_EQ(boolean.bodies, full.bodies) << variant;
        EXPECT_TRUE(boolean.triangles.empty() && boolean.cells.empty());
        (full.bodies.empty() ? apart : touching) += 1;
      }
    }
  }
  EXPECT_GT(touching, 20);
  EXPECT_GT(apart, 20);
}

TEST_P(EveryMember, DeclaresWhatItAnswers) {
  const auto declared = [&](const std::string& variant) {
    return prepared(GetParam() + variant, judged_family_scenes().front().scene)->semantics();
  };
  const Semantics tri = declared("+tri"), paper_tri = declared("+tri:bounds=paper"),
                  paper = declared(""), safe = declared(":bounds=safe");
  EXPECT_TRUE(tri.exact && tri.claims(Level::kTriangle) && !tri.claims(Level::kCell));
  EXPECT_FALSE(paper_tri.exact || paper.exact || safe.exact);
  EXPECT_EQ(tri.questions.front(), Question::kTriangles);
  EXPECT_EQ(paper.questions.front(), Question::kCells);
  EXPECT_TRUE(paper.claims(Level::kCell) && !paper.claims(Level::kTriangle));
  EXPECT_EQ(paper.claims(Level::kBox), GetParam() != "ffd-grid");
  EXPECT_FALSE(safe.claims(Level::kBox));
}

TEST_P(EveryMember, NeedsVerticesOnlyForTheTriangleTest) {
  const Scene& scene = judged_family_scenes().front().scene;
  EXPECT_TRUE(prepared(GetParam() + "+tri", scene)->needs_vertices());
  const auto lazy = prepared(GetParam(), scene);
  EXPECT_FALSE(lazy->needs_vertices());
  Frame frame = scene.frames.back().frame();
  const ContactSet expected = answer(*lazy, scene.frames.back());
  for (BodyState& body : frame.bodies) body.vertices = {};
  lazy->update(frame);
  ContactSet found;
  lazy->query(Question::kCells, found);
  found.canonicalize();
  EXPECT_EQ(found.cells, expected.cells);
  EXPECT_FALSE(found.cells.empty());
}

}  // namespace
}  // namespace contactcheck
