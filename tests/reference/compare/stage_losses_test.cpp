#include "reference/compare/stage_losses.h"

#include <gmock/gmock.h>

#include <numeric>

#include "reference/compare/judge.h"
#include "tests/reference/compare/labelled_bodies.h"

namespace contactcheck {
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

std::vector<std::uint64_t> missed(const StageLosses& losses) {
  std::vector<std::uint64_t> out;
  for (const results::Stage& s : losses.stages()) out.push_back(s.missed);
  return out;
}

std::vector<std::uint64_t> missed_of(const StageTrace& trace,
                                     const std::vector<ElementPair>& truth) {
  const std::vector<Body> bodies = labelled_bodies();
  StageLosses losses(bodies);
  losses.add_frame(trace, truth);
  return missed(losses);
}

const std::vector<ElementPair> kTruth = {
    {0, 1, 0, 0}, {0, 1, 1, 2}, {0, 1, 2, 2}, {0, 2, 0, 0}, {1, 2, 3, 3}};

TEST(StageLosses, BodyStageLosesEveryPairOfBodiesItDropped) {
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

TEST(StageLosses, TriangleStageKeepsExactlyItsPairs) {
  const StageTrace trace{{stage("triangles", Kind::kTriangles, {{0, 1, 0, 0}, {0, 1, 2, 2}})}, {}};
  EXPECT_THAT(missed_of(trace, kTruth), ElementsAre(3));
}

TEST(StageLosses, APairIsLostOnceByTheFirstStageThatDropsIt) {
  StageTrace trace;
  trace.stages = {stage("sphere1", Kind::kBodies, {}, {{0, 1}}),
                  stage("hash", Kind::kLabelCells, {{0, 1, 0, 0}, {0, 1, 0, 1}}),
                  stage("triangles", Kind::kTriangles, {})};
  // Body pairs (0, 2) and (1, 2) go first, then (2, 2) whose cells are (1, 1), then the rest.
  EXPECT_THAT(missed_of(trace, kTruth), ElementsAre(2, 1, 2));
}

TEST(StageLosses, CountsAddUpOverFrames) {
  const std::vector<Body> bodies = labelled_bodies();
  StageLosses losses(bodies);
  const StageTrace trace{{stage("triangles", Kind::kTriangles, {{0, 1, 0, 0}})}, {}};
  losses.add_frame(trace, kTruth);
  losses.add_frame(trace, {});
  losses.add_frame(trace, {{0, 1, 0, 0}, {0, 1, 2, 2}});
  ASSERT_EQ(losses.stages().size(), 1u);
  EXPECT_EQ(losses.stages()[0].name, "triangles");
  EXPECT_EQ(losses.stages()[0].unit, "pairs");
  EXPECT_EQ(losses.stages()[0].in, 30u);
  EXPECT_EQ(losses.stages()[0].out, 12u);
  EXPECT_EQ(losses.stages()[0].missed, 5u);
}

TEST(StageLosses, AddUpToTheMissedOfTheLevel) {
  const std::vector<ElementPair> reported = {{0, 1, 0, 0}};
  StageTrace trace;
  trace.stages = {stage("sphere1", Kind::kBodies, {}, {{0, 1}, {1, 2}}),
                  stage("hash", Kind::kLabelCells, {{0, 1, 0, 0}, {0, 1, 1, 1}}),
                  stage("triangles", Kind::kTriangles, reported)};
  const std::vector<std::uint64_t> losses = missed_of(trace, kTruth);

  const std::vector<Body> bodies = labelled_bodies();
  Judge judge(bodies, {}, {Level::kTriangle});
  Truth truth;
  truth.surface.triangles = kTruth;
  ContactSet answer;
  answer.triangles = reported;
  judge.add_frame(0, truth, answer);
  EXPECT_EQ(std::accumulate(losses.begin(), losses.end(), std::uint64_t{0}),
            judge.levels().at(Level::kTriangle).missed);
  EXPECT_EQ(judge.levels().at(Level::kTriangle).missed, 4u);
}

TEST(StageLosses, DetectorWithoutStagesHasNone) {
  const std::vector<Body> bodies = labelled_bodies();
  StageLosses losses(bodies);
  losses.add_frame({}, kTruth);
  EXPECT_TRUE(losses.stages().empty());
}

TEST(StageLossesDeathTest, StagesMustNotChangeOverFrames) {
  const std::vector<Body> bodies = labelled_bodies();
  StageLosses losses(bodies);
  losses.add_frame({{stage("triangles", Kind::kTriangles, {})}, {}}, {});
  EXPECT_DEATH(losses.add_frame({}, {}), "stages do not change");
}

}  // namespace
}  // namespace contactcheck
