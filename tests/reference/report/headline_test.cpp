#include "reference/report/tables/headline.h"

#include <gmock/gmock.h>

namespace contactcheck::report {
namespace {

using results::Results, results::Run;
using testing::ElementsAre;
using testing::IsEmpty;

// A row that answers with all pairs of triangles.
Run row(const std::string& scene, const std::string& detector, std::uint64_t missed,
        std::uint64_t spurious, std::optional<double> ms = {}) {
  Run run;
  run.scene = scene;
  run.detector = detector;
  run.frames = 10;
  run.semantics.questions = {Question::kTriangles};
  run.per_frame.level = Level::kTriangle;
  run.levels[Level::kTriangle] = {16, 16 - missed + spurious, 16 - missed, missed, spurious};
  if (!ms) return run;
  run.times.resize(1);
  run.times[0].playback.frame = *ms;
  return run;
}

Results run_of(const std::vector<std::string>& scenes, std::vector<Run> runs) {
  Results results;
  for (const std::string& id : scenes) results.scenes.emplace_back().id = id;
  results.runs = std::move(runs);
  return results;
}

std::string sentence_about(const Results& results, const std::string& topic) {
  for (const HeadlineFinding& finding : headline_of(results).findings)
    if (finding.topic == topic) return finding.sentence;
  return "";
}

TEST(Headline, TitleSaysHowManyWereRight) {
  EXPECT_EQ(headline_of(run_of({"a", "b"}, {row("a", "x", 0, 0), row("a", "y", 1, 0)})).title,
            "1 of 2 detectors has no missed and no spurious contacts in 2 scenes");
  EXPECT_EQ(headline_of(run_of({"a"}, {row("a", "x", 0, 0)})).title,
            "x has no missed and no spurious contacts in 1 scene");
  EXPECT_EQ(headline_of(run_of({"a"}, {row("a", "x", 0, 2)})).title,
            "x has missed or spurious contacts in 1 scene");
  EXPECT_EQ(headline_of(run_of({"a"}, {row("a", "x", 0, 0), row("a", "y", 0, 0)})).title,
            "All 2 detectors have no missed and no spurious contacts in 1 scene");
  EXPECT_EQ(headline_of(run_of({"a"}, {row("a", "x", 1, 0), row("a", "y", 1, 0)})).title,
            "All 2 detectors have missed or spurious contacts in 1 scene");
  EXPECT_EQ(headline_of(run_of({}, {})).title, "Nothing was judged in this run");
}

TEST(Headline, TitleCountsWhatWasJudged) {
  results::Run unclaimed = row("b", "x", 0, 0);
  unclaimed.levels.clear();
  EXPECT_EQ(headline_of(run_of({"a", "b"}, {row("a", "x", 0, 0), unclaimed})).title,
            "x has no missed and no spurious contacts in 1 of 2 scenes");
  Results with_family = run_of({"b", "hard"}, {unclaimed, row("hard", "x", 0, 0)});
  with_family.scenes[1].family.emplace().values = {"1", "2", "3"};
  EXPECT_EQ(headline_of(with_family).title,
            "x has no missed and no spurious contacts in 3 hard cases");
}

// Bodies that are apart, and were reported so.
Run apart(const std::string& scene, const std::string& detector, Level level) {
  Run run = row(scene, detector, 0, 0);
  run.per_frame.level = level;
  run.levels = {{level, {0, 0, 0, 0, 0}}};
  return run;
}

TEST(Headline, NothingToFindAndNothingReportedIsRight) {
  EXPECT_EQ(
      headline_of(run_of({"a"}, {apart("a", "x", Level::kBody), apart("a", "y", Level::kTriangle)}))
          .title,
      "All 2 detectors have no missed and no spurious contacts in 1 scene");
  for (const Level level : {Level::kTriangle, Level::kCell, Level::kBox, Level::kNear, Level::kSelf,
                            Level::kSelfCell, Level::kContainment}) {
    const Results alone = run_of({"a"}, {apart("a", "x", level)});
    EXPECT_EQ(headline_of(alone).title, "x has no missed and no spurious contacts in 1 scene");
    EXPECT_EQ(sentence_about(alone, "No missed or spurious contacts"),
              std::string("At level ") + name_of(level) + ": x.");
  }
}

TEST(Headline, NothingToFindAndSomethingReportedIsWrong) {
  Results results = run_of({"a"}, {apart("a", "x", Level::kBody), apart("a", "y", Level::kBody)});
  results.runs[1].levels[Level::kBody] = {0, 3, 0, 0, 3};
  EXPECT_EQ(headline_of(results).title,
            "1 of 2 detectors has no missed and no spurious contacts in 1 scene");
}

// Nor was one that is not built, refused the input, or claims none of the levels.
TEST(Headline, WhoWasNotJudgedIsNotCounted) {
  Results results = run_of({"a"}, {apart("a", "x", Level::kBody), row("a", "absent", 0, 0),
                                   row("a", "refused", 0, 0), row("a", "other", 0, 0)});
  results.runs[1].status = results::Status::kAbsent;
  results.runs[2].status = results::Status::kRefused;
  for (std::size_t r = 1; r < 4; ++r) results.runs[r].levels.clear();
  EXPECT_EQ(headline_of(results).title, "x has no missed and no spurious contacts in 1 scene");
  results.runs.erase(results.runs.begin());
  EXPECT_EQ(headline_of(results).title, "Nothing was judged in 1 scene");
}

TEST(Headline, FamiliesCountByTheirCases) {
  Results results = run_of({"a", "gap"}, {row("gap", "x", 0, 0)});
  results.scenes[1].family.emplace().values = {"0", "1e-9", "1e-3"};
  EXPECT_EQ(headline_of(results).title,
            "x has no missed and no spurious contacts in 1 scene and 3 hard cases");
}

TEST(Headline, AnErrorIsNoFlawlessRun) {
  Results results = run_of({"a", "b"}, {row("a", "x", 0, 0), row("b", "x", 0, 0)});
  results.runs[1].status = results::Status::kError;
  results.runs[1].message = "signal 11";
  EXPECT_EQ(headline_of(results).title,
            "x has missed or spurious contacts, or status error, in 2 scenes");
  EXPECT_EQ(sentence_about(results, "Ended in an error"), "x in b (signal 11).");
}

// Also where it never answered.
TEST(Headline, CountsTheDetectorsThatEndedInAnError) {
  Results results = run_of({"a"}, {row("a", "x", 0, 0), row("a", "y", 0, 0)});
  results.runs[1].status = results::Status::kError;
  results.runs[1].levels.clear();
  EXPECT_EQ(headline_of(results).title,
            "1 of 2 detectors has no missed and no spurious contacts in 1 scene; 1 ended in status "
            "error");
  results.runs.erase(results.runs.begin());
  EXPECT_EQ(headline_of(results).title, "y ended in status error in 1 scene");
}

TEST(Headline, WhatTheOracleCouldNotJudgeIsNobodysError) {
  Results results = run_of({"a", "b"}, {row("a", "x", 0, 0), row("b", "x", 0, 0)});
  results.runs[1].status = results::Status::kError;
  results.scenes[1].unjudged = "scene b: no progress";
  EXPECT_EQ(headline_of(results).title, "x has no missed and no spurious contacts in 1 scene");
  EXPECT_EQ(sentence_about(results, "Ended in an error"), "");
  EXPECT_EQ(sentence_about(results, "Not judged"), "scene b: no progress.");
}

TEST(Headline, InformativeLevelsAreHeldAgainstNobody) {
  Results results = run_of({"a"}, {row("a", "x", 0, 0)});
  results.runs[0].levels[Level::kVertex] = {5, 0, 0, 5, 0};
  results.runs[0].levels[Level::kVertex].informative = true;
  EXPECT_EQ(headline_of(results).title, "x has no missed and no spurious contacts in 1 scene");
}

TEST(Headline, TheWrongAreNamedWorstFirst) {
  const Results results = run_of(
      {"a"}, {row("a", "x", 1, 0), row("a", "y", 4, 0), row("a", "z", 0, 0), row("a", "w", 0, 8)});
  EXPECT_EQ(sentence_about(results, "Missed"),
            "2 detectors did not report all true contacts, at level triangle: y 25.0 % (4 of 16) "
            "and x 6.3 % (1 of 16).");
  EXPECT_EQ(sentence_about(results, "Spurious"),
            "1 detector reported spurious contacts, at level triangle: w 33.3 % (8 of 24).");
  EXPECT_EQ(sentence_about(results, "No missed or spurious contacts"), "At level triangle: z.");
}

TEST(Headline, TheFastestOfThoseThatWereRightIsFoundSceneByScene) {
  std::vector<results::Run> runs = {row("a", "x", 0, 0, 2.0),
                                    row("a", "y", 0, 0, 1.0),
                                    row("b", "x", 0, 0, 1.0),
                                    row("b", "y", 0, 0, 4.0),
                                    row("c", "x", 0, 0, 1.0),
                                    row("c", "y", 0, 0, 4.0),
                                    row("c", "fast-and-wrong", 1, 0, 0.1)};
  runs[2].speedup[Question::kTriangles]["embree"].playback = {3.0, 2.0, 4.0};
  runs[4].speedup[Question::kTriangles]["embree"].playback = {5.0, 4.0, 6.0};
  // Where it was not the fastest: the time is not of that scene.
  runs[0].speedup[Question::kTriangles]["embree"].playback = {9.0, 8.0, 10.0};
  const Results results = run_of({"a", "b", "c"}, runs);
  const std::string cheapest =
      "x in 2 of 3 scenes: 3.00 to 5.00x embree, of all pairs of triangles, 1.00 ms per frame; y "
      "in "
      "a";
  EXPECT_EQ(sentence_about(results, "Cheapest without errors"), cheapest + ".");
  EXPECT_EQ(headline_of(results).cheapest, cheapest);
  EXPECT_THAT(headline_of(results).fastest, ElementsAre("x", "y"));
  EXPECT_THAT(headline_of(run_of({"a"}, {row("a", "x", 0, 0, 2.0)})).fastest, IsEmpty())
      << "alone it beats nobody";
}

TEST(Headline, TheCheapestInOneSceneHasTheIntervalOfItsPasses) {
  std::vector<results::Run> runs = {row("a", "x", 0, 0, 1.0), row("a", "fcl-aabb", 0, 0, 3.0)};
  results::Speedup& speedup = runs[0].speedup[Question::kTriangles]["fcl-aabb"];
  speedup.playback = {3.0, 2.5, 3.5};
  speedup.passes = 5;
  EXPECT_EQ(headline_of(run_of({"a"}, runs)).cheapest,
            "x: 3.00x [2.50, 3.50] fcl-aabb, of all pairs of triangles, 1.00 ms per frame");
}

TEST(Headline, TheCheapestIsOfTheQuestionOfMostScenes) {
  std::vector<results::Run> runs;
  for (const char* const scene : {"a", "b", "folds"})
    for (const auto& [detector, ms] : {std::pair{"x", 2.0}, std::pair{"y", 1.0}}) {
      runs.push_back(row(scene, detector, 0, 0, ms));
      if (scene == std::string("folds")) runs.back().times[0].question = Question::kSelf;
    }
  EXPECT_EQ(headline_of(run_of({"a", "b", "folds"}, runs)).cheapest,
            "y in all 2 scenes, of all pairs of triangles, 1.00 ms per frame");
}

// Of questions of as many scenes it is what a scene of self-contact is about; who answers another
// question, or was wrong, cannot be compared.
TEST(Headline, TheCheapestIsOfOneQuestion) {
  std::vector<results::Run> runs;
  for (const auto& [detector, question, ms] :
       {std::tuple{"x", Question::kSelf, 2.0}, std::tuple{"y", Question::kSelf, 1.0},
        std::tuple{"bodies", Question::kBody, 0.1}, std::tuple{"wrong", Question::kSelf, 0.1}}) {
    runs.push_back(row("a", detector, detector == std::string("wrong") ? 1 : 0, 0, ms));
    runs.back().times[0].question = question;
  }
  EXPECT_EQ(headline_of(run_of({"a"}, runs)).cheapest,
            "y, of all contacts of bodies with themselves, 1.00 ms per frame");
}

TEST(Headline, ContactSeenFartherOffThanDeclaredIsToldApart) {
  Results results = run_of({"a", "b"}, {row("a", "x", 0, 0), row("b", "x", 0, 0),
                                        row("a", "skin", 0, 0), row("a", "exact", 0, 0)});
  for (results::Scene& scene : results.scenes) scene.size = 1.0;
  results.runs[0].geometry.hover_gap_max = 0.004;
  results.runs[1].geometry.hover_gap_max = 0.0287;
  for (results::Run& run : results.runs)
    run.semantics.margin = run.detector == "exact" ? 0.0 : 0.002;
  results.runs[2].geometry.hover_gap_max = 0.002;  // as declared
  results.runs[3].geometry.hover_gap_max = 1e-7;   // as well as the moment is known
  EXPECT_EQ(headline_of(results).title,
            "All 3 detectors have no missed and no spurious contacts in 2 scenes");
  EXPECT_EQ(sentence_about(results, "Too early"),
            "1 detector reported contact of bodies farther apart than declared: x 28.7 mm (margin "
            "2.00 mm).");
}

TEST(Headline, DepthsAndNormalsHaveSentencesOfTheirOwn) {
  Results results =
      run_of({"a", "b"}, {row("a", "x", 0, 0), row("b", "x", 0, 0), row("a", "y", 0, 0)});
  EXPECT_EQ(sentence_about(results, "Depth, convex-pair") + sentence_about(results, "Normal"), "");
  for (results::Run& run : results.runs) run.geometry.depth_kind = DepthKind::kConvexPair;
  results.runs[0].geometry.depth.max = 0.001;
  results.runs[1].geometry.depth.max = 0.0005;
  results.runs[2].geometry.depth.max = 0.25;
  results.runs[1].geometry.normal_deg.max = 80.0;
  results.runs[0].geometry.depth.mean = 0.0004;
  results.runs[0].geometry.depth.judged = 3;
  results.runs[1].geometry.depth.mean = 0.0;
  results.runs[1].geometry.depth.judged = 1;
  results.runs[2].geometry.normal_deg.max = 0.0;  // never off
  EXPECT_EQ(sentence_about(results, "Depth, convex-pair"),
            "Largest error: y 250 mm and x 1.00 mm (mean 0.300).");
  EXPECT_EQ(sentence_about(results, "Normal"), "Largest error: x 80.0 degrees.");
}

TEST(Headline, GoalsAreCounted) {
  Results results = run_of({"a"}, {row("a", "x", 0, 0)});
  results.goals.resize(3);
  results.goals[0].met = true;
  results.goals[1].met = false;
  EXPECT_EQ(sentence_about(results, "Goals"),
            "1 of 3 goals of the suite is met; 1 goal could not be measured.");
}

TEST(Headline, TheJudgeItselfIsJudged) {
  Results results = run_of({"random-pairs"}, {row("random-pairs", "x", 0, 0)});
  results.scenes[0].pairs.emplace().checked = 1'000'000;
  EXPECT_EQ(sentence_about(results, "The judge itself"),
            "On 1,000,000 random pairs of triangles the oracle was never wrong (checked by "
            "rational arithmetic).");
  results.scenes[0].pairs->oracle_wrong = 2;
  EXPECT_THAT(sentence_about(results, "The judge itself"),
              testing::HasSubstr("was wrong 2 times: an error of contactcheck itself"));
}

}  // namespace
}  // namespace contactcheck::report
