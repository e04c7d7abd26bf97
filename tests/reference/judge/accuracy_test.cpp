#include "reference/judge/accuracy.h"

#include <gmock/gmock.h>

#include <limits>
#include <numeric>

#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "tests/faults/broken_detectors.h"
#include "tests/support/approach_scene.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

scene::Scene spheres() {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 2), {3, 3, 3}).shape;
  return test::approach_scene(ball, ball, {{0.0, 1.4}, {1.0, 0.85}, {2.0, 1.4}}, 0.05, 0.03, 12,
                              2.0 / 12.0, {Level::kBody, Level::kCell, Level::kTriangle});
}

struct Judged : results::Run {
  std::vector<Disagreement> disagreements;
};

Judged accuracy_of(const scene::Scene& scene, Detector& detector) {
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  const JudgedScene judged = judge_scene(scene, progress);
  Judged result;
  JudgingTools tools(judged);
  result.disagreements = run_accuracy(tools, 0, detector, progress, result).disagreements;
  return result;
}

Judged accuracy_of(const scene::Scene& scene, const std::string& name) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  adapters::register_reference_detectors(catalog);
  return accuracy_of(scene, *catalog.make(catalog.parse(name)));
}

TEST(Accuracy, ExactDetectorsAreExact) {
  const scene::Scene scene = spheres();
  std::string hash;
  for (const char* name : {"fcl-aabb", "fcl-obbrss", "ffd-grid+tri", "ffd-aabb+tri",
                           "ffd-aabb-sphere2+tri", "ffd-aabb-sphereN+tri"}) {
    const Judged result = accuracy_of(scene, name);
    EXPECT_GT(result.levels.at(Level::kTriangle).truth, 20u);
    EXPECT_TRUE(result.levels.at(Level::kTriangle).perfect()) << name;
    EXPECT_TRUE(result.levels.at(Level::kBody).perfect()) << name;
    EXPECT_TRUE(result.disagreements.empty()) << name;
    if (hash.empty()) hash = result.contact_hash;
    EXPECT_EQ(result.contact_hash, hash) << name;
  }
}

TEST(Accuracy, RecognisesExchangedTriangles) {
  test::SwapsIds swaps;
  const Judged swapped = accuracy_of(spheres(), swaps);
  ASSERT_EQ(swapped.notes.size(), 1u);
  EXPECT_EQ(swapped.notes[0],
            "reports all " + std::to_string(swapped.levels.at(Level::kTriangle).missed) +
                " missed pairs with a and b exchanged; a belongs to the body with the lower index");
  test::DropsEveryTenth drops;
  EXPECT_TRUE(accuracy_of(spheres(), drops).notes.empty());
  EXPECT_TRUE(accuracy_of(spheres(), "fcl-aabb").notes.empty());
}

TEST(Accuracy, CountsFramesAndContactFrames) {
  const Judged result = accuracy_of(spheres(), "fcl-aabb");
  EXPECT_EQ(result.frames, 12u);
  EXPECT_EQ(result.per_frame.level, Level::kTriangle);
  const auto touching = std::count_if(result.per_frame.truth.begin(), result.per_frame.truth.end(),
                                      [](std::uint64_t n) { return n > 0; });
  EXPECT_EQ(result.contact_frames, static_cast<std::size_t>(touching));
  EXPECT_GT(touching, 2);
  EXPECT_LT(touching, 10);
}

TEST(Accuracy, StageLossesOfThePaperAddUpToItsMissed) {
  const scene::Scene scene = spheres();
  for (const char* name : {"ffd-aabb-sphere2", "ffd-grid", "ffd-aabb-sphere2+tri:bounds=paper"}) {
    const Judged result = accuracy_of(scene, name);
    const Level level = result.levels.count(Level::kTriangle) ? Level::kTriangle : Level::kCell;
    std::uint64_t lost = 0;
    for (const results::Stage& s : result.stages) lost += s.missed;
    EXPECT_EQ(lost, result.levels.at(level).missed) << name;
    EXPECT_GE(result.stages.size(), 2u) << name;
  }
}

TEST(Accuracy, RunsOfOneDetectorHaveOneHash) {
  const scene::Scene scene = spheres();
  const Judged first = accuracy_of(scene, "ffd-grid"), again = accuracy_of(scene, "ffd-grid");
  EXPECT_GT(first.levels.at(Level::kCell).reported, 0u);
  EXPECT_EQ(first.contact_hash, again.contact_hash);
  scene::Scene aside = spheres();
  aside.motions[1].path.position[1].keys = {{0.0, 0.4}};
  EXPECT_NE(first.contact_hash, accuracy_of(aside, "ffd-grid").contact_hash);
}

// The question `body` is timed, so its own answer is judged, not the bodies of the triangles.
TEST(Accuracy, BodiesAreJudgedByTheAnswerToTheirOwnQuestion) {
  const scene::Scene scene = spheres();
  test::LiesAboutBodies never(false), always(true);
  const Judged silent = accuracy_of(scene, never), talkative = accuracy_of(scene, always);
  EXPECT_TRUE(silent.levels.at(Level::kTriangle).perfect());
  EXPECT_EQ(silent.levels.at(Level::kBody).missed, silent.contact_frames);
  EXPECT_EQ(silent.levels.at(Level::kBody).reported, 0u);
  EXPECT_TRUE(talkative.levels.at(Level::kTriangle).perfect());
  EXPECT_EQ(talkative.levels.at(Level::kBody).missed, 0u);
  EXPECT_EQ(talkative.levels.at(Level::kBody).spurious,
            talkative.frames - talkative.contact_frames);
}

// Its first question is `body`, which ends at the first pair of triangles. Loses pairs on demand.
class AnswersBodiesFirst : public test::DropsEveryTenth {
 public:
  explicit AnswersBodiesFirst(bool loses_pairs) : loses_pairs_(loses_pairs) {
    semantics_ = DropsEveryTenth::semantics();
    std::reverse(semantics_.questions.begin(), semantics_.questions.end());
  }
  const Semantics& semantics() const override { return semantics_; }
  void query(Question question, ContactSet& out) override {
    if (question == Question::kTriangles && loses_pairs_)
      return DropsEveryTenth::query(question, out);
    out.triangles = truth_.triangles;
    if (question == Question::kBody && !out.triangles.empty()) out.triangles.resize(1);
  }

 private:
  Semantics semantics_;
  bool loses_pairs_;
};

TEST(Accuracy, TrianglesAreJudgedByTheAnswerToTheirQuestionAlsoWhereItIsNotTheFirst) {
  const scene::Scene scene = spheres();
  AnswersBodiesFirst right(false), wrong(true);
  ASSERT_EQ(right.semantics().questions.front(), Question::kBody);
  const Judged perfect = accuracy_of(scene, right), losing = accuracy_of(scene, wrong);
  const std::uint64_t pairs = perfect.levels.at(Level::kTriangle).truth;
  EXPECT_EQ(perfect.levels.at(Level::kTriangle).hit, pairs);
  EXPECT_TRUE(perfect.disagreements.empty());
  EXPECT_GE(losing.levels.at(Level::kTriangle).missed, pairs / 10);
  EXPECT_LT(losing.levels.at(Level::kTriangle).missed, pairs);
  EXPECT_TRUE(losing.levels.at(Level::kBody).perfect());
  // Which pairs are missing shows in the hash, too.
  EXPECT_EQ(perfect.contact_hash, accuracy_of(scene, "fcl-aabb").contact_hash);
  EXPECT_NE(perfect.contact_hash, losing.contact_hash);
}

// Finds nothing, and holds so much memory in each frame.
class HoldsMemory : public Detector {
 public:
  explicit HoldsMemory(std::vector<std::size_t> bytes) : bytes_(std::move(bytes)) {
    semantics_.levels = {Level::kBody};
    semantics_.questions = {Question::kBody};
  }
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return false; }
  void prepare(const std::vector<Body>&) override {}
  void update(const Frame&) override { held_ = std::vector<char>(bytes_.at(frame_++)); }
  void query(Question, ContactSet&) override {}

 private:
  Semantics semantics_;
  std::vector<std::size_t> bytes_;
  std::size_t frame_ = 0;
  std::vector<char> held_;
};

TEST(Accuracy, MemoryIsThatOfTheFrameThatTakesMost) {
  if (test::kSanitizerAllocates) GTEST_SKIP() << "a sanitizer allocates in glibc's place";
  constexpr std::size_t kMebibyte = std::size_t{1} << 20;
  const scene::Scene scene = spheres();
  for (const std::size_t most : {std::size_t{0}, scene.frames / 2, scene.frames - 1}) {
    std::vector<std::size_t> bytes(scene.frames, kMebibyte);
    bytes[most] = 8 * kMebibyte;
    HoldsMemory detector(bytes);
    const std::uint64_t memory = accuracy_of(scene, detector).memory_bytes;
    EXPECT_GE(memory, 8 * kMebibyte) << most;
    EXPECT_LT(memory, 10 * kMebibyte) << most;
  }
}

TEST(JudgeScene, StopsAtANonFiniteNodeAndSaysWhere) {
  scene::Scene scene = spheres();
  scene.recorded = test::recorded_frames(scene);
  scene.recorded[4][1][9].y() = std::numeric_limits<double>::quiet_NaN();
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  const JudgedScene judged = judge_scene(scene, progress);
  EXPECT_EQ(judged.refused, "frame 4, body \"moving\": node 9 is not finite");
  EXPECT_EQ(judged.truth.size(), 4u);
}

TEST(JudgeScene, ComputesOnlyTheTruthThatTheSceneWants) {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 1), {2, 2, 2}).shape;
  const auto shell = test::make_body("", test::sphere_mesh(Vec3::Zero(), 2.0, 1), {2, 2, 2}).shape;
  scene::Scene scene =
      test::approach_scene(shell, ball, {{0.0, 0.0}}, 0, 0, 1, 1.0, {Level::kTriangle});
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  EXPECT_TRUE(judge_scene(scene, progress).truth.at(0).containment.empty());
  // Level body wants it too, for detectors that take bodies for solids.
  for (const Level level : {Level::kContainment, Level::kBody}) {
    scene.levels = {level};
    EXPECT_EQ(judge_scene(scene, progress).truth.at(0).containment.size(), 1u);
  }
}

}  // namespace
}  // namespace contactcheck::judge
