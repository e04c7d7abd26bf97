#include "reference/judge/judge.h"

#include <gmock/gmock.h>

#include "tests/reference/judge/labelled_bodies.h"

namespace contactcheck::judge {
namespace {

using test::labelled_bodies;
using test::labelled_body;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::uint64_t> numbers(const results::LevelCounts& c) {
  return {c.truth, c.reported, c.hit, c.missed, c.spurious};
}

ElementPair pair(std::uint32_t a, std::uint32_t b) { return {0, 1, a, b}; }

ContactSet answer_of(std::vector<ElementPair> triangles) {
  ContactSet answer;
  answer.triangles = std::move(triangles);
  answer.canonicalize();
  return answer;
}

ContactSet cells_of(std::vector<ElementPair> cells) {
  ContactSet answer;
  answer.cells = std::move(cells);
  answer.canonicalize();
  return answer;
}

ContactSet bodies_of(std::vector<BodyPair> bodies) {
  ContactSet answer;
  answer.bodies = std::move(bodies);
  answer.canonicalize();
  return answer;
}

results::LevelCounts judged(Level level, const oracle::Truth& truth, const ContactSet& answer,
                            Semantics semantics = {}) {
  return compare_at(level, labelled_bodies(), semantics, truth, answer).counts;
}

TEST(Judge, EqualCountsOfDifferentPairsAreMissedAndSpurious) {
  const results::LevelCounts counts =
      judged(Level::kTriangle, test::truth_of({pair(0, 0), pair(1, 1)}),
             answer_of({pair(0, 0), pair(2, 3)}));
  EXPECT_THAT(numbers(counts), ElementsAre(2, 2, 1, 1, 1));
}

TEST(Judge, AnsweringTheTruthIsPerfectAtEveryLevel) {
  const oracle::Truth truth = test::truth_of({pair(0, 0), pair(2, 3)});
  EXPECT_THAT(numbers(judged(Level::kTriangle, truth, truth.surface)), ElementsAre(2, 2, 2, 0, 0));
  EXPECT_THAT(numbers(judged(Level::kBody, truth, truth.surface)), ElementsAre(1, 1, 1, 0, 0));
}

TEST(Judge, SilenceMissesAllAndIsNotSpurious) {
  const results::LevelCounts counts =
      judged(Level::kTriangle, test::truth_of({pair(0, 0), pair(1, 1), pair(2, 2)}), ContactSet{});
  EXPECT_THAT(numbers(counts), ElementsAre(3, 0, 0, 3, 0));
}

TEST(Judge, CellLevelCountsTrianglePairsOfTruthAndCellPairsOfTheAnswer) {
  // Cells (0, 0) cover the pairs (0, 0), (0, 1) and (1, 1); cells (0, 1) cover (0, 1), (1, 1) and
  // nothing else of the truth; (1, 0) covers (1, 1). (2, 2) needs cells (1, 1).
  const oracle::Truth truth = test::truth_of({pair(0, 0), pair(0, 1), pair(1, 1), pair(2, 2)});
  EXPECT_THAT(numbers(judged(Level::kCell, truth, cells_of({pair(0, 0)}))),
              ElementsAre(4, 1, 3, 1, 0));
  EXPECT_THAT(numbers(judged(Level::kCell, truth, cells_of({pair(0, 0), pair(1, 1)}))),
              ElementsAre(4, 2, 4, 0, 0));
}

TEST(Judge, CellPairThatCoversNoTruePairIsSpurious) {
  const oracle::Truth truth = test::truth_of({pair(0, 0)});
  EXPECT_THAT(numbers(judged(Level::kCell, truth, cells_of({pair(0, 0), pair(1, 1)}))),
              ElementsAre(1, 2, 1, 0, 1));
}

TEST(Judge, CellPairOfOtherBodiesCoversNothing) {
  const oracle::Truth truth = test::truth_of({pair(0, 0)});
  EXPECT_THAT(numbers(judged(Level::kCell, truth, cells_of({ElementPair{0, 2, 0, 0}}))),
              ElementsAre(1, 1, 0, 1, 1));
}

// Triangle 0 lies in cell 0, triangle 1 in both cells, triangle 2 in cell 1, which shares no node
// with cell 0: of the pair (0, 2) alone the contact is one of cells apart.
TEST(Judge, SelfCellClaimsContactsOfCellsApartAlone) {
  const auto shape = std::make_shared<BodyShape>(*test::labelled_body("body").shape);
  shape->lattice->cells = {{0, 0, 0}, {2, 0, 0}};
  const auto judged_self = [&](std::vector<SelfPair> triangles, std::vector<SelfPair> cells) {
    oracle::Truth truth;
    truth.surface.self = std::move(triangles);
    ContactSet answer;
    answer.self_cells = std::move(cells);
    return numbers(compare_at(Level::kSelfCell, {{"body", shape}}, {}, truth, answer, {}).counts);
  };
  const std::vector<SelfPair> all = {{0, 0, 1}, {0, 0, 2}, {0, 1, 2}};
  EXPECT_THAT(judged_self(all, {{0, 0, 1}}), ElementsAre(1, 1, 1, 0, 0));
  EXPECT_THAT(judged_self(all, {}), ElementsAre(1, 0, 0, 1, 0));
  EXPECT_THAT(judged_self({{0, 0, 1}}, {{0, 0, 1}}), ElementsAre(0, 1, 0, 0, 0));
  EXPECT_THAT(judged_self({}, {{0, 0, 1}}), ElementsAre(0, 1, 0, 0, 1));
}

TEST(Judge, BoxLevelComparesCellPairsWithOverlappingBoxes) {
  oracle::Truth truth;
  truth.boxes = {pair(0, 1), pair(1, 0)};
  EXPECT_THAT(numbers(judged(Level::kBox, truth, cells_of({pair(0, 1), pair(1, 1)}))),
              ElementsAre(2, 2, 1, 1, 1));
}

TEST(Judge, VertexLevelComparesBodyHolderAndVertex) {
  oracle::Truth truth;
  truth.surface.vertices = {{0, 1, 5}, {1, 0, 5}};
  ContactSet answer;
  answer.vertices = {{0, 1, 5}, {1, 2, 5}};
  EXPECT_THAT(numbers(judged(Level::kVertex, truth, answer)), ElementsAre(2, 2, 1, 1, 1));
}

TEST(Judge, SurfaceDetectorThatReportsContainmentIsSpurious) {
  oracle::Truth truth;
  truth.containment = {{0, 2}};
  EXPECT_THAT(numbers(judged(Level::kBody, truth, bodies_of({{0, 2}}))),
              ElementsAre(0, 1, 0, 0, 1));
}

TEST(Judge, SolidDetectorMustReportContainmentToo) {
  oracle::Truth truth;
  truth.surface.bodies = {{0, 1}};
  truth.containment = {{0, 2}};
  Semantics solid;
  solid.solid = true;
  EXPECT_THAT(numbers(judged(Level::kBody, truth, bodies_of({{0, 1}, {0, 2}}), solid)),
              ElementsAre(2, 2, 2, 0, 0));
  EXPECT_THAT(numbers(judged(Level::kBody, truth, bodies_of({{0, 1}}), solid)),
              ElementsAre(2, 1, 1, 1, 0));
}

TEST(Judge, SurfaceContactIsNotSpuriousAtContainment) {
  oracle::Truth truth;
  truth.surface.bodies = {{0, 1}};
  truth.containment = {{0, 2}};
  EXPECT_THAT(numbers(judged(Level::kContainment, truth, bodies_of({{0, 1}, {0, 2}}))),
              ElementsAre(1, 1, 1, 0, 0));
  EXPECT_THAT(numbers(judged(Level::kContainment, truth, bodies_of({{0, 1}, {1, 2}}))),
              ElementsAre(1, 1, 0, 1, 1));
}

TEST(Judge, CountsAreSumsOverFrames) {
  LevelTotals totals({}, {Level::kTriangle});
  test::add_frame(totals, {}, 0, test::truth_of({pair(0, 0)}), answer_of({pair(0, 0)}));
  test::add_frame(totals, {}, 1, test::truth_of({pair(0, 0), pair(1, 1)}), answer_of({pair(1, 1)}));
  test::add_frame(totals, {}, 2, test::truth_of({}), answer_of({pair(3, 3)}));
  EXPECT_THAT(numbers(totals.levels.at(Level::kTriangle)), ElementsAre(3, 3, 2, 1, 1));
  EXPECT_THAT(totals.per_frame.truth, ElementsAre(1, 2, 0));
  EXPECT_THAT(totals.per_frame.missed, ElementsAre(0, 1, 0));
  EXPECT_THAT(totals.per_frame.spurious, ElementsAre(0, 0, 1));
}

TEST(Judge, SeriesPerFrameIsOfTheFinestLevel) {
  EXPECT_EQ(LevelTotals({}, {Level::kBody, Level::kTriangle}).per_frame.level, Level::kTriangle);
  EXPECT_EQ(LevelTotals({}, {Level::kBody, Level::kBox, Level::kCell}).per_frame.level,
            Level::kCell);
  EXPECT_EQ(LevelTotals({}, {Level::kBody}).per_frame.level, Level::kBody);
  LevelTotals totals({}, {Level::kBody, Level::kTriangle});
  test::add_frame(totals, {}, 0, test::truth_of({pair(0, 0), pair(1, 1), pair(2, 2)}),
                  answer_of({pair(0, 0)}));
  EXPECT_THAT(totals.per_frame.truth, ElementsAre(3));
  EXPECT_THAT(totals.per_frame.missed, ElementsAre(2));
}

TEST(Judge, KeepsTheFirstDisagreementOfEachKindAndLevel) {
  LevelTotals totals({}, {Level::kBody, Level::kTriangle});
  test::add_frame(totals, {}, 3, test::truth_of({pair(0, 0)}), answer_of({pair(0, 0)}));
  test::add_frame(totals, {}, 4, test::truth_of({pair(0, 0), pair(1, 2)}), answer_of({pair(0, 0)}));
  test::add_frame(totals, {}, 5, test::truth_of({pair(0, 0), pair(2, 2)}),
                  answer_of({pair(0, 0), pair(3, 1)}));
  test::add_frame(totals, {}, 6, test::truth_of({pair(0, 0)}), answer_of({}));
  ASSERT_EQ(totals.disagreements.size(), 3u);
  const auto& d = totals.disagreements;
  EXPECT_EQ(d[0].level + " " + d[0].kind, "triangle missed");
  EXPECT_EQ(d[0].frame, 4u);
  EXPECT_EQ(d[0].pair, pair(1, 2));
  EXPECT_EQ(d[1].level + " " + d[1].kind, "triangle spurious");
  EXPECT_EQ(d[1].frame, 5u);
  EXPECT_EQ(d[1].pair, pair(3, 1));
  EXPECT_EQ(d[2].level + " " + d[2].kind, "body missed");
  EXPECT_EQ(d[2].frame, 6u);
  EXPECT_EQ(d[2].pair, pair(0, 0));
}

TEST(Judge, SelfNearComparesWithThePairsOfOneBody) {
  Semantics semantics;
  semantics.margin = 0.25;
  LevelTotals totals(semantics, {Level::kSelfNear});
  ContactSet answer;
  answer.near = {{0, 1, 5, 2}};
  answer.self_near = {{0, 0, 7, 2}, {1, 1, 7, 4}};
  answer.canonicalize();
  EXPECT_THAT(answer.self_bodies, ElementsAre(0, 1));
  test::add_frame(
      totals, semantics, 0, oracle::Truth{}, answer,
      {{Level::kNear, {{0, 1, 5, 2}}}, {Level::kSelfNear, {{0, 0, 7, 2}, {0, 0, 8, 2}}}});
  EXPECT_THAT(numbers(totals.levels.at(Level::kSelfNear)), ElementsAre(2, 2, 1, 1, 1));
  EXPECT_EQ(totals.levels.at(Level::kSelfNear).margin, 0.25);
  EXPECT_EQ(totals.per_frame.level, Level::kSelfNear);
  ASSERT_EQ(totals.disagreements.size(), 2u);
  EXPECT_EQ(totals.disagreements[0].pair, (ElementPair{0, 0, 8, 2}));
  EXPECT_EQ(elements_of("self-near", "missed"),
            (NamedElements{Element::kVertex, Element::kTriangle}));
}

TEST(Judge, MissedAtCellLevelNamesTrianglesAndSpuriousNamesCells) {
  LevelTotals totals({}, {Level::kCell});
  test::add_frame(totals, {}, 0, test::truth_of({pair(3, 3)}), cells_of({pair(0, 1)}));
  ASSERT_EQ(totals.disagreements.size(), 2u);
  EXPECT_EQ(totals.disagreements[0].kind, "missed");
  EXPECT_EQ(totals.disagreements[0].pair, pair(3, 3));
  EXPECT_EQ(totals.disagreements[1].kind, "spurious");
  EXPECT_EQ(totals.disagreements[1].pair, pair(0, 1));
}

TEST(Judge, NearLevelComparesWithThePairsBelowTheMargin) {
  LevelTotals totals({}, {Level::kNear});
  ContactSet answer;
  answer.near = {{0, 1, 5, 2}, {1, 0, 5, 2}};
  answer.canonicalize();
  test::add_frame(totals, {}, 0, oracle::Truth{}, answer,
                  {{Level::kNear, {{0, 1, 5, 2}, {0, 1, 5, 3}, {1, 2, 5, 2}}}});
  EXPECT_THAT(numbers(totals.levels.at(Level::kNear)), ElementsAre(3, 2, 1, 2, 1));
  EXPECT_EQ(totals.per_frame.level, Level::kNear);
  ASSERT_EQ(totals.disagreements.size(), 2u);
  EXPECT_EQ(totals.disagreements[0].pair, (ElementPair{0, 1, 5, 3}));
}

TEST(Judge, InformativeLevelIsCountedButNeverADisagreementNorTheFinest) {
  Semantics semantics;
  semantics.levels = {Level::kBody};
  semantics.informative = {Level::kVertex};
  LevelTotals totals(semantics, {Level::kBody, Level::kVertex});
  EXPECT_EQ(totals.per_frame.level, Level::kBody);
  oracle::Truth truth;
  truth.surface.vertices = {{0, 1, 5}};
  ContactSet answer;
  answer.vertices = {{1, 2, 5}};
  test::add_frame(totals, semantics, 0, truth, answer);
  EXPECT_THAT(numbers(totals.levels.at(Level::kVertex)), ElementsAre(1, 1, 0, 1, 1));
  EXPECT_THAT(totals.disagreements, IsEmpty());
}

// Whatever the order of the questions.
TEST(QuestionOf, IsTheOneAboutTheLevel) {
  Semantics semantics;
  const auto of = [&](Level level, std::vector<Question> questions) {
    semantics.questions = std::move(questions);
    return question_of(level, semantics);
  };
  EXPECT_EQ(of(Level::kTriangle, {Question::kBody, Question::kTriangles}), Question::kTriangles);
  EXPECT_EQ(of(Level::kTriangle, {Question::kContacts, Question::kTriangles}),
            Question::kTriangles);
  EXPECT_EQ(of(Level::kCell, {Question::kTriangles, Question::kCells}), Question::kCells);
  EXPECT_EQ(of(Level::kBox, {Question::kBody, Question::kCells}), Question::kCells);
  for (const Level level : {Level::kBody, Level::kContainment}) {
    EXPECT_EQ(of(level, {Question::kTriangles, Question::kBody}), Question::kBody);
    EXPECT_EQ(of(level, {Question::kContacts, Question::kTriangles}), Question::kContacts);
  }
}

TEST(QuestionOf, WithoutOneAboutTheLevelIsTheFirstThatMayNotEndEarly) {
  Semantics semantics;
  semantics.questions = {Question::kBody, Question::kContacts, Question::kTriangles};
  for (const Level level : {Level::kVertex, Level::kNear, Level::kCell})
    EXPECT_EQ(question_of(level, semantics), Question::kContacts);
  semantics.questions = {Question::kBody};
  for (const Level level : kLevels)
    if (!is_self(level) && !is_impact(level)) {
      EXPECT_EQ(question_of(level, semantics), Question::kBody);
    }
}

TEST(QuestionOf, SelfContactAndStepsIsTheirsAlone) {
  Semantics semantics;
  semantics.questions = {Question::kImpacts, Question::kTriangles, Question::kBody};
  for (const Level level : kLevels) {
    const Question question = question_of(level, semantics);
    if (is_self(level)) {
      EXPECT_EQ(question, Question::kSelf) << name_of(level);
    } else if (is_impact(level)) {
      EXPECT_EQ(question, is_self_impact(level) ? Question::kSelfImpacts : Question::kImpacts)
          << name_of(level);
    } else {
      EXPECT_FALSE(is_of_steps(question)) << name_of(level);
    }
  }
}

TEST(QuestionAbout, ListsOfStepsIsOneOfSteps) {
  Semantics semantics;
  semantics.questions = {Question::kTriangles, Question::kImpacts, Question::kSelfImpacts};
  ContactSet set;
  for_each_list(
      [&](ContactList list, const auto&) {
        EXPECT_EQ(is_of_steps(question_about(list, semantics)), is_of_step(list));
      },
      set);
  EXPECT_EQ(question_about(ContactList::kImpactEdges, semantics), Question::kImpacts);
  EXPECT_EQ(question_about(ContactList::kSelfImpactEdges, semantics), Question::kSelfImpacts);
}

std::vector<Question> questions_in(const std::vector<Level>& wanted,
                                   std::vector<Question> questions) {
  Semantics semantics;
  semantics.levels = {kLevels.begin(), kLevels.end()};
  semantics.questions = std::move(questions);
  return semantics_in(wanted, semantics).questions;
}

TEST(SemanticsIn, AreAskedWhatTheSceneIsAbout) {
  const std::vector<Question> all = {Question::kTriangles, Question::kBody, Question::kSelf,
                                     Question::kImpacts, Question::kSelfImpacts};
  EXPECT_THAT(questions_in({Level::kBody}, all),
              ElementsAre(Question::kTriangles, Question::kBody));
  EXPECT_THAT(questions_in({Level::kImpactVf}, all), ElementsAre(Question::kImpacts));
  EXPECT_THAT(questions_in({Level::kImpactSelfEe}, all), ElementsAre(Question::kSelfImpacts));
  EXPECT_THAT(questions_in({Level::kBody, Level::kImpact}, all),
              ElementsAre(Question::kTriangles, Question::kBody, Question::kImpacts));
  EXPECT_THAT(questions_in({Level::kSelf, Level::kImpactSelfVf}, all),
              ElementsAre(Question::kSelf, Question::kSelfImpacts));
}

// One of steps cannot be asked about frames; one of frames is asked all the same.
TEST(SemanticsIn, OfStepsAloneAreAskedNothingWhereNoStepIsJudged) {
  EXPECT_THAT(
      questions_in({Level::kTriangle, Level::kSelf}, {Question::kImpacts, Question::kSelfImpacts}),
      IsEmpty());
  EXPECT_THAT(questions_in({Level::kImpactSelfVf}, {Question::kImpacts}), IsEmpty());
  EXPECT_THAT(questions_in({Level::kImpact}, {Question::kTriangles, Question::kBody}),
              ElementsAre(Question::kTriangles, Question::kBody));
  EXPECT_THAT(questions_in({Level::kSelf}, {Question::kTriangles, Question::kBody}),
              ElementsAre(Question::kTriangles, Question::kBody));
}

TEST(SemanticsIn, ClaimTheLevelsOfWhatTheSceneIsAbout) {
  Semantics semantics;
  semantics.levels = {kLevels.begin(), kLevels.end()};
  semantics.questions = {kQuestions.begin(), kQuestions.end()};
  const auto of = [&](Level wanted) { return semantics_in({wanted}, semantics).levels; };
  EXPECT_THAT(of(Level::kImpactEe), ElementsAre(Level::kImpactVf, Level::kImpactEe,
                                                Level::kImpactTriangle, Level::kImpact));
  EXPECT_THAT(of(Level::kImpactSelfVf), ElementsAre(Level::kImpactSelfVf, Level::kImpactSelfEe));
  for (const Level level : of(Level::kCell))
    EXPECT_FALSE(is_self(level) || is_impact(level)) << name_of(level);
}

TEST(JudgedLevels, HoldWhatIsInformativeToo) {
  Semantics semantics;
  semantics.levels = {Level::kBody};
  semantics.informative = {Level::kVertex};
  std::map<Level, std::string> not_judged;
  EXPECT_THAT(judged_levels(labelled_bodies(), {}, semantics,
                            {Level::kBody, Level::kVertex, Level::kTriangle}, &not_judged),
              ElementsAre(Level::kBody, Level::kVertex));
}

TEST(JudgedLevels, AreThoseClaimedAndWanted) {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kTriangle};
  std::map<Level, std::string> not_judged;
  EXPECT_THAT(judged_levels(labelled_bodies(), {}, semantics, {Level::kTriangle, Level::kCell},
                            &not_judged),
              ElementsAre(Level::kTriangle));
  EXPECT_THAT(not_judged, IsEmpty());
}

TEST(JudgedLevels, OneOpenBodyStopsContainmentAndVertexWithAReason) {
  const std::vector<Body> bodies = labelled_bodies();
  std::vector<std::string> open;
  note_open_bodies(bodies, 2, {}, open);
  note_open_bodies(bodies, 3, {{1, {7, 4, 5}}}, open);
  note_open_bodies(bodies, 4, {{1, {0, 0, 1}}}, open);  // later
  const std::string why = "not judged: open (body \"second\", frame 3, edge of vertices 4 and 5)";
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kContainment, Level::kVertex, Level::kCell};
  std::map<Level, std::string> not_judged;
  EXPECT_THAT(judged_levels(bodies, open, semantics, semantics.levels, &not_judged),
              ElementsAre(Level::kBody, Level::kCell));
  EXPECT_EQ(not_judged.size(), 2u);
  EXPECT_EQ(not_judged[Level::kContainment], why);
  EXPECT_EQ(not_judged[Level::kVertex], why);
}

TEST(JudgedLevels, OneBodyWithoutLatticeStopsCellAndBoxWithAReason) {
  std::vector<Body> bodies = labelled_bodies();
  bodies.push_back(labelled_body("bare", false));
  Semantics semantics;
  semantics.levels = {Level::kCell, Level::kBox, Level::kTriangle};
  std::map<Level, std::string> not_judged;
  EXPECT_THAT(judged_levels(bodies, {}, semantics, semantics.levels, &not_judged),
              ElementsAre(Level::kTriangle));
  EXPECT_EQ(not_judged[Level::kCell], "not judged: a body has no lattice");
  EXPECT_EQ(not_judged[Level::kBox], "not judged: a body has no lattice");
}

std::vector<FrameDifferences> differences_of(Level level, const oracle::Truth& truth,
                                             const ContactSet& answer, std::size_t listed) {
  LevelTotals totals({}, {Level::kBody, level}, listed);
  test::add_frame(totals, {}, 4, truth, answer);
  return totals.differences;
}

TEST(Judge, ListsTheDifferencesOfItsFinestLevel) {
  const auto frames = differences_of(Level::kTriangle, test::truth_of({pair(0, 0), pair(1, 1)}),
                                     answer_of({pair(1, 1), pair(2, 3)}), 9);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].frame, 4u);
  EXPECT_EQ(frames[0].missed.count, 1u);
  EXPECT_THAT(frames[0].missed.pairs, ElementsAre(pair(0, 0)));
  EXPECT_EQ(frames[0].spurious.count, 1u);
  EXPECT_THAT(frames[0].spurious.pairs, ElementsAre(pair(2, 3)));
}

TEST(Judge, ListsTheFirstDifferencesAndCountsAll) {
  const auto frames = differences_of(
      Level::kTriangle, test::truth_of({pair(3, 3), pair(0, 0), pair(1, 1)}), ContactSet{}, 2);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].missed.count, 3u);
  EXPECT_THAT(frames[0].missed.pairs, ElementsAre(pair(0, 0), pair(1, 1)));
}

TEST(Judge, ListsMissedTrianglesAndSpuriousCells) {
  const auto frames = differences_of(Level::kCell, test::truth_of({pair(0, 0), pair(2, 2)}),
                                     cells_of({pair(0, 0), pair(1, 0)}), 9);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_THAT(frames[0].missed.pairs, ElementsAre(pair(2, 2)));
  EXPECT_THAT(frames[0].spurious.pairs, ElementsAre(pair(1, 0)));
}

TEST(Judge, ListsNothingOfPerfectFramesNorUnlessAsked) {
  const oracle::Truth truth = test::truth_of({pair(0, 0)});
  EXPECT_THAT(differences_of(Level::kTriangle, truth, truth.surface, 9), IsEmpty());
  EXPECT_THAT(differences_of(Level::kTriangle, truth, ContactSet{}, 0), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::judge
