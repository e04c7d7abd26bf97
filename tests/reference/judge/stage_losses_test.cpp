// Which stage of a detector missed which true pairs.
#include <gmock/gmock.h>

#include <numeric>

#include "reference/judge/judge.h"
#include "tests/reference/judge/labelled_bodies.h"

namespace contactcheck::judge {
namespace {

using test::labelled_bodies;
using testing::ElementsAre;
using Kind = StageRecord::Kind;

StageRecord stage(const char* name, Kind kind, std::vector<ElementPair> elements,
                  std::vector<BodyPair> bodies = {}) {
  StageRecord s;
  s.name = name;
  s.unit = "pairs";
  s.in = 10;
  s.out = 4;
  s.kind = kind;
  s.elements = std::move(elements);
  s.bodies = std::move(bodies);
  return s;
}

std::vector<std::uint64_t> missed_of(const StageTrace& trace,
                                     const std::vector<ElementPair>& truth) {
  std::vector<results::Stage> stages;
  add_stages(labelled_bodies(), trace, truth, stages);
  std::vector<std::uint64_t> out;
  for (const results::Stage& s : stages) out.push_back(s.missed);
  return out;
}

const std::vector<ElementPair> kTruth = {
    {0, 1, 0, 0}, {0, 1, 1, 2}, {0, 1, 2, 2}, {0, 2, 0, 0}, {1, 2, 3, 3}};

TEST(StageLosses, BodyStageMissesEveryPairOfBodiesItDropped) {
  const StageTrace trace{{stage("sphere1", Kind::kBodies, {}, {{0, 1}, {1, 2}})}, {}};
  EXPECT_THAT(missed_of(trace, kTruth), ElementsAre(1));
}

TEST(StageLosses, LabelStageKeepsPairsThroughAnyOfTheirCells) {
  // (1, 2) has the labels {0, 1} x {1}: cells (0, 1) keep it, (1, 1) would too.
  const StageTrace trace{{stage("hash", Kind::kLabelCells, {{0, 1, 0, 1}})}, {}};
  EXPECT_THAT(missed_of(trace, {{0, 1, 0, 0}, {0, 1, 1, 2}, {0, 1, 2, 2}}), ElementsAre(2));
}

TEST(StageLosses, OwnerStageKeepsPairsThroughTheirOwnersAlone) {
  StageTrace trace{{stage("hash", Kind::kOwnerCells, {{0, 1, 0, 1}})}, {}};
  trace.owner = {{0, 1, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 0}};
  // Triangle 1 of the first body wears label 0 too, but its owner is cell 1.
  EXPECT_THAT(missed_of(trace, {{0, 1, 0, 2}, {0, 1, 1, 2}}), ElementsAre(1));
}

TEST(StageLosses, ActiveLabelsKeepPairsOfTheBodiesListed) {
  StageRecord sphere = stage("sphere2", Kind::kActiveLabelCells, {}, {{0, 1}});
  sphere.active = {{0, 1}, {0, 1}, {1, 1}};
  // (1, 2) has the labels {0, 1} x {1}; (0, 0) has the labels {0} x {0}; (0, 2) is not listed.
  EXPECT_THAT(missed_of({{sphere}, {}}, {{0, 1, 0, 0}, {0, 1, 1, 2}, {0, 2, 2, 0}}),
              ElementsAre(2));
}

TEST(StageLosses, ActiveOwnersKeepPairsThroughTheirOwnersAlone) {
  StageRecord sphere = stage("sphere2", Kind::kActiveOwnerCells, {}, {{0, 1}});
  sphere.active = {{1, 0}, {0, 1}, {1, 1}};
  StageTrace trace{{sphere}, {{0, 1, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 0}}};
  // Triangle 1 of the first body has the label 0 too, but its owner is cell 1.
  EXPECT_THAT(missed_of(trace, {{0, 1, 0, 2}, {0, 1, 1, 2}, {0, 1, 0, 1}}), ElementsAre(2));
}

TEST(StageLosses, TriangleStageKeepsExactlyItsPairs) {
  const StageTrace trace{{stage("triangles", Kind::kTriangles, {{0, 1, 0, 0}, {0, 1, 2, 2}})}, {}};
  EXPECT_THAT(missed_of(trace, kTruth), ElementsAre(3));
}

TEST(StageLosses, APairIsMissedOnceByTheFirstStageThatDropsIt) {
  StageTrace trace;
  trace.stages = {stage("sphere1", Kind::kBodies, {}, {{0, 1}}),
                  stage("hash", Kind::kLabelCells, {{0, 1, 0, 0}, {0, 1, 0, 1}}),
                  stage("triangles", Kind::kTriangles, {})};
  // Body pairs (0, 2) and (1, 2) go first, then (2, 2) whose cells are (1, 1), then the rest.
  EXPECT_THAT(missed_of(trace, kTruth), ElementsAre(2, 1, 2));
}

TEST(StageLosses, CountsAddUpOverFrames) {
  const std::vector<Body> bodies = labelled_bodies();
  std::vector<results::Stage> stages;
  const StageTrace trace{{stage("triangles", Kind::kTriangles, {{0, 1, 0, 0}})}, {}};
  add_stages(bodies, trace, kTruth, stages);
  add_stages(bodies, trace, {}, stages);
  add_stages(bodies, trace, {{0, 1, 0, 0}, {0, 1, 2, 2}}, stages);
  ASSERT_EQ(stages.size(), 1u);
  EXPECT_EQ(stages[0].name, "triangles");
  EXPECT_EQ(stages[0].unit, "pairs");
  EXPECT_EQ(stages[0].in, 30u);
  EXPECT_EQ(stages[0].out, 12u);
  EXPECT_EQ(stages[0].missed, 5u);
}

TEST(StageLosses, AddUpToTheMissedOfTheLevel) {
  const std::vector<ElementPair> reported = {{0, 1, 0, 0}};
  StageTrace trace;
  trace.stages = {stage("sphere1", Kind::kBodies, {}, {{0, 1}, {1, 2}}),
                  stage("hash", Kind::kLabelCells, {{0, 1, 0, 0}, {0, 1, 1, 1}}),
                  stage("triangles", Kind::kTriangles, reported)};
  const std::vector<std::uint64_t> losses = missed_of(trace, kTruth);

  oracle::Truth truth;
  truth.surface.triangles = kTruth;
  ContactSet answer;
  answer.triangles = reported;
  const std::uint64_t missed =
      compare_at(Level::kTriangle, labelled_bodies(), {}, truth, answer).counts.missed;
  EXPECT_EQ(std::accumulate(losses.begin(), losses.end(), std::uint64_t{0}), missed);
  EXPECT_EQ(missed, 4u);
}

TEST(StageLosses, DetectorWithoutStagesHasNone) {
  const std::vector<Body> bodies = labelled_bodies();
  std::vector<results::Stage> stages;
  add_stages(bodies, {}, kTruth, stages);
  EXPECT_TRUE(stages.empty());
}

TEST(StageLossesDeathTest, StagesMustNotChangeOverFrames) {
  const std::vector<Body> bodies = labelled_bodies();
  std::vector<results::Stage> stages;
  add_stages(bodies, {{stage("triangles", Kind::kTriangles, {})}, {}}, {}, stages);
  EXPECT_DEATH(add_stages(bodies, {}, {}, stages), "stages do not change");
}

}  // namespace
}  // namespace contactcheck::judge
