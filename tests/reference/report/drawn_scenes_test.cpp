#include "reference/report/drawn_scenes.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/level_tables.h"
#include "reference/report/markdown.h"
#include "reference/report/page_data.h"
#include "reference/report/scene_choice.h"
#include "reference/report/terminal.h"

namespace contactcheck::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

results::Run run_of(const std::string& scene, const std::string& detector, std::uint64_t missed) {
  results::Run run;
  run.scene = scene;
  run.detector = detector;
  run.frames = 8;
  run.semantics.questions = {Question::kTriangles};
  run.semantics.levels = {Level::kTriangle};
  run.per_frame.level = Level::kTriangle;
  run.levels[Level::kTriangle] = {10, 10 - missed, 10 - missed, missed, 0};
  return run;
}

// `ratio`: the time of the reference in terms of the run's own.
void time_over(const std::string& reference, double ratio, results::Run& run) {
  if (run.times.empty()) {
    run.times.emplace_back();
    run.times.back().timed_frames = run.frames;
    run.times.back().passes = 3;
    run.times.back().playback.frame = 1.0;
  }
  results::Speedup& speedup = run.speedup[Question::kTriangles][reference];
  speedup.playback = {ratio, ratio, ratio};
  speedup.passes = 3;
}

// Scenes drawn-7-1 and on; every second one has contact. "fast" is (number) times as fast as
// fcl-aabb and half that over embree, so that more triangles are better for it; it misses one
// contact in the third scene.
results::Results drawn_results(std::size_t count) {
  results::Results out;
  for (std::size_t i = 1; i <= count; ++i) {
    results::Scene& scene = out.scenes.emplace_back();
    scene.id = "drawn-7-" + std::to_string(i);
    scene.frames = 8;
    scene.contact_frames = i % 2 == 0 ? 0 : 4;
    const double n = static_cast<double>(i);
    scene.drawn = results::Drawn{7, i, 0, "touch", {{"triangles", 100.0 * n}, {"speed", 0.5}}};
    results::Run fcl = run_of(scene.id, "fcl-aabb", 0), fast = run_of(scene.id, "fast", i == 3);
    time_over("fcl-aabb", 1.0, fcl);
    time_over("fcl-aabb", n, fast);
    time_over("embree", 0.5 * n, fast);
    out.runs.push_back(fcl);
    out.runs.push_back(fast);
  }
  return out;
}

TEST(DrawnScenes, AreNoSectionWhereNoneWasDrawn) {
  results::Results results = drawn_results(1);
  results.scenes[0].drawn.reset();
  EXPECT_EQ(drawn_report(results).text, "");
  EXPECT_EQ(drawn_markdown(results), "");
  EXPECT_FALSE(page_data(results, {}).contains("drawn"));
}

TEST(DrawnScenes, CountErrorsWithAndWithoutContactApart) {
  const DrawnReport report = drawn_report(drawn_results(5));
  EXPECT_EQ(report.text, "5 scenes drawn from seed 7, 3 with contact.");
  ASSERT_THAT(report.accuracy, SizeIs(2));
  EXPECT_EQ(report.accuracy[0].title, "Missed and spurious in 3 scenes with contact");
  EXPECT_THAT(
      report.accuracy[0].rows,
      ElementsAre(ElementsAre("fcl-aabb", "3", "triangle", "30", "0", "1", "0", "0", "0", "-"),
                  ElementsAre("fast", "3", "triangle", "30", "1", "0.96666", "0", "0", "1", "-")));
  EXPECT_EQ(report.accuracy[1].title, "Missed and spurious in 2 scenes without contact");
  EXPECT_EQ(report.accuracy[1].rows[1][0], "fast");
  EXPECT_EQ(report.accuracy[1].rows[1][4], "0");
  EXPECT_THAT(report.wrong.rows,
              ElementsAre(ElementsAre("fast", "1", "drawn-7-3 (1 missed)", "-")));
}

TEST(DrawnScenes, SumsOfDifferentLevelsAreApart) {
  results::Results results = drawn_results(5);
  results::Run& fast = results.runs[1];
  fast.per_frame.level = Level::kBody;
  fast.levels[Level::kBody] = {4, 5, 4, 0, 1};
  const TitledTable table = drawn_report(results).accuracy[0];
  ASSERT_THAT(table.rows, SizeIs(3));
  EXPECT_THAT(table.rows[1],
              ElementsAre("fast", "1", "body", "4", "0", "1", "1", "0.20000", "1", "-"));
  EXPECT_THAT(table.rows[2],
              ElementsAre("fast", "2", "triangle", "20", "1", "0.95000", "0", "0", "1", "-"));
}

TEST(DrawnScenes, ThoseWithoutAnswerAreNoScoreAndAreSaid) {
  results::Results results = drawn_results(5);
  results.runs[1].status = results::Status::kError;
  results.runs[9].status = results::Status::kRefused;
  results.scenes[4].drawn->redrawn = 2;
  results.scenes[2].unjudged = "too large";
  const DrawnReport report = drawn_report(results);
  EXPECT_EQ(report.text,
            "5 scenes drawn from seed 7, 2 with contact. 1 of them was drawn again because a limit "
            "of time or memory ended the judging. 1 could not be judged within the limits and is "
            "left out below.");
  EXPECT_THAT(report.accuracy[0].rows[1],
              ElementsAre("fast", "0", "-", "0", "0", "-", "0", "-", "0", "1 error, 1 refused"));
  EXPECT_THAT(report.wrong.rows, ElementsAre(ElementsAre("fast", "1", "drawn-7-1 (error)", "-")));
}

TEST(DrawnScenes, SpeedUpsAreMedianTenthPercentileAndWorst) {
  const DrawnReport report = drawn_report(drawn_results(40));
  ASSERT_THAT(report.speedups, SizeIs(2));
  // Ratios 1, 3, ..., 39, and half of that.
  EXPECT_EQ(report.speedups[0].title, "Speed-ups in 20 scenes with contact");
  EXPECT_THAT(report.speedups[0].rows,
              ElementsAre(ElementsAre("fast", "triangles", "fcl-aabb", "20", "20.0x", "3.00x",
                                      "1.00x", "drawn-7-1", "19"),
                          ElementsAre("fast", "triangles", "embree", "20", "10.0x", "1.50x",
                                      "0.500x", "drawn-7-1", "19"),
                          ElementsAre("fast", "triangles", "the fastest", "20", "10.0x", "1.50x",
                                      "0.500x", "drawn-7-1", "19")));
  EXPECT_EQ(report.speedups[1].rows[0][4], "21.0x") << "2, 4, ..., 40";
  EXPECT_EQ(report.speedups[1].rows[0][6], "2.00x");
}

TEST(DrawnScenes, WithoutTimesHaveNoSpeedUps) {
  results::Results results = drawn_results(12);
  for (results::Run& run : results.runs) {
    run.times.clear();
    run.speedup.clear();
  }
  const DrawnReport report = drawn_report(results);
  EXPECT_THAT(report.speedups[0].rows, IsEmpty());
  EXPECT_THAT(report.decides, IsEmpty());
  const std::string text = drawn_markdown(results);
  EXPECT_THAT(text, HasSubstr("Missed and spurious in 6 scenes with contact"));
  EXPECT_THAT(text, Not(HasSubstr("Speed-ups")));
  EXPECT_THAT(text, Not(HasSubstr("What decides")));
}

TEST(DrawnScenes, TheParameterThatDecidesIsNamed) {
  const DrawnReport report = drawn_report(drawn_results(30));
  EXPECT_THAT(
      report.decides,
      ElementsAre("`fast` is faster than every reference in 28 of 30 scenes, median 7.75x; "
                  "triangles per body decides most (rank correlation +1.00): median 2.75x up to "
                  "1000, 12.8x from 2100."));
  ASSERT_THAT(report.correlations.rows, SizeIs(3));
  // Of one parameter that varies: 1.96 / sqrt(29).
  EXPECT_THAT(report.correlations.rows[0],
              ElementsAre("fast", "fcl-aabb", "30", "0.36", "triangles per body +1.00",
                          "5.50x up to 1000, 25.5x from 2100"));
}

TEST(DrawnScenes, WhatMayBeChanceDecidesNothing) {
  results::Results results = drawn_results(12);
  for (std::size_t i = 0; i < 12; ++i)  // 0, 1, 2, 0, 1, ...: 0.17 by the ranks
    results.scenes[i].drawn->parameters["triangles"] = static_cast<double>(i % 3);
  const DrawnReport report = drawn_report(results);
  ASSERT_THAT(report.decides, SizeIs(1));
  EXPECT_THAT(report.decides[0], HasSubstr("; no parameter decides: the strongest correlation, +"));
  EXPECT_THAT(report.decides[0], HasSubstr(" with triangles per body, may be chance."));
}

TEST(DrawnScenes, FewScenesShowNoCorrelation) {
  const DrawnReport report = drawn_report(drawn_results(kFewestForCorrelation - 1));
  EXPECT_THAT(report.decides,
              ElementsAre("`fast` is faster than every reference in 7 of 9 scenes, median 2.50x; "
                          "fewer than 10 scenes show no correlation."));
  EXPECT_THAT(report.correlations.rows, IsEmpty());
}

TEST(DrawnScenes, ManyAreShownAsSumsAlone) {
  const results::Results few = drawn_results(kFewestSummedScenes - 1),
                         many = drawn_results(kFewestSummedScenes);
  EXPECT_THAT(markdown_report(few), HasSubstr("\n## drawn-7-2\n"));
  EXPECT_THAT(markdown_report(many), Not(HasSubstr("\n## drawn-7-2\n")));
  EXPECT_THAT(terminal_tables(few, false), HasSubstr("drawn-7-2"));
  EXPECT_THAT(terminal_tables(many, false), Not(HasSubstr("drawn-7-2")));
  const auto page = page_data(many, {});
  EXPECT_THAT(page.at("scenes"), IsEmpty());
  EXPECT_EQ(page.at("scene_count"), kFewestSummedScenes);
  EXPECT_EQ(page.at("drawn").at("accuracy").size(), 2u);
  EXPECT_EQ(page_data(few, {}).at("scenes").size(), kFewestSummedScenes - 1);
  EXPECT_EQ(level_tables(results::Index(many), {}).recall.columns,
            (std::vector<std::string>{"detector", "all scenes"}));
  std::vector<std::string> words;
  for (const SceneChoice& choice : scene_choices(many)) words.push_back(choice.words);
  EXPECT_THAT(words, ElementsAre("all 10 scenes", "5 drawn scenes with contact",
                                 "5 drawn scenes without contact"));
}

TEST(DrawnScenes, OtherScenesAreShownBesideManyDrawnOnes) {
  results::Results results = drawn_results(kFewestSummedScenes);
  results.scenes.push_back(results.scenes[0]);
  results.scenes.back().id = "hello";
  results.scenes.back().drawn.reset();
  results.runs.push_back(run_of("hello", "fast", 0));
  EXPECT_THAT(markdown_report(results), HasSubstr("\n## hello\n"));
  EXPECT_THAT(page_data(results, {}).at("scenes"), SizeIs(1));
}

}  // namespace
}  // namespace contactcheck::report
