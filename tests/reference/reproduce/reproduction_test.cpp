#include "reference/reproduce/reproduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reference/results/results_json.h"
#include "tests/reference/reproduce/sample_run.h"

namespace contactcheck::reproduce {
namespace {

using test::Json;
using test::sample_closed_loop;
using test::sample_reproduction_results;
using test::sample_results;
using test::sample_run;
using test::sample_step_ms;

PaperTables tables() { return test::paper_of_our_methods(); }

Json& scene_of(Json& reproduction) { return reproduction.at("scenes").at(0); }

// The row of two levels of spheres against one.
Json two_over_one(const Json& results) {
  Json reproduction = reproduce(results::from_json(results), tables());
  const Json& row = scene_of(reproduction).at("ratios").at(1);
  EXPECT_EQ(row.at("before"), "ffd-aabb-sphere");
  EXPECT_EQ(row.at("after"), "ffd-aabb-sphere2");
  return row;
}

std::vector<std::string> sentences(const Json& results) {
  Json reproduction = reproduce(results::from_json(results), tables());
  return scene_of(reproduction).at("sentences").get<std::vector<std::string>>();
}

TEST(Reproduction, CountsAreSumsOverTheBodiesBesideThePapers) {
  Json reproduction = reproduce(results::from_json(sample_results()), tables());
  EXPECT_EQ(scene_of(reproduction).at("counts").dump(),
            R"({"objects":{"paper":2.0,"ours":2.0,"difference_percent":0.0},)"
            R"("vertices":{"paper":20.0,"ours":22.0,"difference_percent":10.0},)"
            R"("triangles":{"paper":32.0,"ours":32.0,"difference_percent":0.0},)"
            R"("cells":{"paper":7.0,"ours":6.0,"difference_percent":-14.285714285714286}})");
}

TEST(Reproduction, SaysWhatWasRunAndOnWhat) {
  Json reproduction = reproduce(results::from_json(sample_results()), tables());
  EXPECT_EQ(reproduction.at("schema"), "contactcheck-reproduction/1");
  EXPECT_EQ(reproduction.at("version"), "1.2.3");
  EXPECT_EQ(reproduction.at("command"), "contactcheck reproduce");
  EXPECT_EQ(reproduction.at("machine").at("cpu"), "a cpu");
  EXPECT_EQ(scene_of(reproduction).at("scene"), "s");
  EXPECT_EQ(scene_of(reproduction).at("ours"), "paper-s");
  EXPECT_EQ(scene_of(reproduction).at("frames"), 60);
  EXPECT_EQ(scene_of(reproduction).at("contact_frames"), 41);
}

TEST(Reproduction, StepsStandBesideThePapersNewestTable) {
  Json reproduction = reproduce(results::from_json(sample_reproduction_results()), tables());
  const Json& steps = scene_of(reproduction).at("steps");
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_EQ(steps[0].at("paper_reports").at("table"), "Table 1") << "only there";
  const Json& one = steps[1];
  EXPECT_EQ(one.at("method"), "ffd-aabb-sphere");
  EXPECT_EQ(one.at("paper_reports").dump(),
            R"({"table":"Table 3","device":"box","mss":10.0,"cell":1.0,"test":40.0,"response":4.0,)"
            R"("total":60.0,"sum_of_steps":55.0})");
  EXPECT_EQ(one.at("paper").at("test"), 6.0);
  EXPECT_EQ(one.at("paper").at("total"), 10.0);
  EXPECT_EQ(one.at("paper").at("level"), "cell");
  EXPECT_EQ(one.at("paper").at("truth"), 20);
  EXPECT_EQ(one.at("paper").at("missed"), 3);
  EXPECT_EQ(one.at("paper").at("spurious"), 7);
  EXPECT_EQ(one.at("paper").at("recall"), 0.85);
  EXPECT_EQ(one.at("safe").at("missed"), 0);
  EXPECT_TRUE(one.at("exact").is_null()) << "was not run";
  EXPECT_TRUE(steps[3].at("paper_reports").is_null()) << "no table has N levels";
}

TEST(Reproduction, RatioHasTheRangeOverRepeatsThatRanTogether) {
  const Json row = two_over_one(sample_reproduction_results());
  EXPECT_EQ(row.at("paper_reports").dump(), R"({"table":"Table 3","test":2.0,"total":1.5,)"
                                            R"("test_share_before":0.6666666666666666})");
  const Json& ours = row.at("safe");
  EXPECT_EQ(ours.at("test").dump(), R"({"ratio":1.5,"low":1.25,"high":1.75})");
  EXPECT_EQ(ours.at("total").dump(), R"({"ratio":1.25,"low":1.125,"high":1.375})");
  EXPECT_EQ(ours.at("test_share_before"), 0.6);
  EXPECT_TRUE(row.at("exact").is_null());
}

TEST(Reproduction, RangeHoldsTheRatioOfMediansToo) {
  // The median of the tests may come from another repeat than any quotient.
  Json results = sample_reproduction_results();
  for (const std::size_t i : {0u, 1u})
    results["runs"][i]["step_ms"] = sample_step_ms({.test_by_repeat = {2, 2, 2}});
  results["runs"][0]["step_ms"]["test"] = 3.0;
  const Json test = two_over_one(results).at("safe").at("test");
  EXPECT_EQ(test.dump(), R"({"ratio":1.5,"low":1.0,"high":1.5})");
}

TEST(Reproduction, SameContactsGoesByTheHash) {
  const Json row = two_over_one(sample_reproduction_results());
  EXPECT_EQ(row.at("safe").at("same_contacts"), true);
  EXPECT_EQ(row.at("paper").at("same_contacts"), false);
  EXPECT_EQ(row.at("paper").at("missed_before"), 3);
  EXPECT_EQ(row.at("paper").at("missed_after"), 5);
}

TEST(Reproduction, SentencesNameBothNumbersWhereOursFallsShort) {
  const std::vector<std::string> wanted = {
      "The collision test of ffd-aabb-sphere takes 1.50 times as long as that of "
      "ffd-aabb-sphere2; Table 3 of the paper says 2.00, ours is 25 % below. Its spheres leave "
      "25.0 % of the pairs of cells that ffd-aabb-sphere takes to the hash.",
      "A whole step gains 1.250 and not 1.500: the collision test is 60.0 % of our step with "
      "ffd-aabb-sphere (66.7 % in the paper), so that no test, however fast, could gain more "
      "than 2.500."};
  EXPECT_EQ(sentences(sample_reproduction_results()), wanted);
}

TEST(Reproduction, SentenceSaysNothingOfSpheresWithoutAHash) {
  Json results = sample_reproduction_results();
  results["runs"][1]["stages"].erase(1);
  EXPECT_TRUE(sentences(results).at(0).ends_with("ours is 25 % below."));
  EXPECT_EQ(two_over_one(results).at("safe").at("into_hash_before"), 40);
  EXPECT_TRUE(two_over_one(results).at("safe").at("into_hash_after").is_null());
}

TEST(Reproduction, ThereIsNoSentenceWhereOursReachesThePaper) {
  // 6 over 3 ms is the paper's 2.00; 10 over 7 ms of a whole step still is no 1.500.
  Json results = sample_reproduction_results();
  results["runs"][1]["step_ms"] = sample_step_ms({.test_by_repeat = {3, 3, 3}});
  const std::vector<std::string> one = sentences(results);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NE(one[0].find("A whole step gains 1.429"), std::string::npos) << one[0];
  results["runs"][1]["step_ms"] = sample_step_ms({.test_by_repeat = {2, 2, 2}});
  EXPECT_TRUE(sentences(results).empty());
}

TEST(Reproduction, SceneThatTheResultsDoNotHoldIsLeftOut) {
  Json results = sample_reproduction_results();
  results["scenes"][0]["id"] = "paper-other";
  const Json reproduction = reproduce(results::from_json(results), tables());
  EXPECT_TRUE(reproduction.at("scenes").empty());
  EXPECT_TRUE(reproduction.at("means").is_null());
}

TEST(Reproduction, RunThatIsNotOkIsNull) {
  Json results = sample_reproduction_results();
  Json& broken = results["runs"][1];
  broken = Json::parse(R"({"scene": "paper-s", "detector": "ffd-aabb-sphere2:bounds=safe",
                           "status": "error", "message": "killed"})");
  Json reproduction = reproduce(results::from_json(results), tables());
  EXPECT_TRUE(scene_of(reproduction).at("steps").at(2).at("safe").is_null());
  EXPECT_TRUE(scene_of(reproduction).at("ratios").at(1).at("safe").is_null());
  EXPECT_FALSE(scene_of(reproduction).at("ratios").at(1).at("paper").is_null());
  EXPECT_TRUE(scene_of(reproduction).at("sentences").empty());
  EXPECT_TRUE(reproduction.at("means").is_null());
}

TEST(Reproduction, RunWithoutWholeStepsIsNull) {
  Json results = sample_reproduction_results();
  results["runs"][1].erase("step_ms");
  EXPECT_TRUE(two_over_one(results).at("safe").is_null());
}

TEST(Reproduction, RunOfAnotherSceneIsNotTaken) {
  Json results = sample_reproduction_results();
  for (Json& run : results["runs"]) run["scene"] = "paper-t";
  EXPECT_TRUE(two_over_one(results).at("safe").is_null());
}

TEST(Reproduction, FrameRateIsOfTheProposalAsItIsWritten) {
  Json reproduction = reproduce(results::from_json(sample_reproduction_results()), tables());
  const Json& rate = scene_of(reproduction).at("frame_rate");
  EXPECT_EQ(rate.at("detector"), "ffd-aabb-sphere2");
  EXPECT_DOUBLE_EQ(rate.at("steps_per_second").get<double>(), 1000.0 / 6.0);
  EXPECT_DOUBLE_EQ(rate.at("simulated_over_real_time").get<double>(), 20.0 / 6.0);
  Json recorded = sample_reproduction_results();
  recorded["scenes"][0].erase("simulation");
  reproduction = reproduce(results::from_json(recorded), tables());
  EXPECT_TRUE(scene_of(reproduction).at("frame_rate").is_null());
}

TEST(Reproduction, ClosedLoopsAreTakenOverWithTheirDetectors) {
  Json results = sample_reproduction_results();
  results["runs"][1]["closed_loop"] = sample_closed_loop();
  results["runs"][2]["closed_loop"]["error"] = "the simulation diverged";
  Json reproduction = reproduce(results::from_json(results), tables());
  const Json& loops = scene_of(reproduction).at("closed_loop");
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].at("detector"), "ffd-aabb-sphere2:bounds=safe");
  EXPECT_EQ(loops[0].at("tunnelling_events"), 3);
  EXPECT_EQ(loops[1].at("error"), "the simulation diverged");
}

Json with_hover(const Json& grid, const Json& proposal) {
  Json results = sample_reproduction_results();
  const Json step_ms = results.at("runs")[1].at("step_ms");
  for (const auto& [detector, hover] :
       {std::pair("ffd-grid", grid), std::pair("ffd-aabb-sphere2", proposal)}) {
    Json run = sample_run(detector, step_ms, "0x1", 0);
    run["closed_loop"] = sample_closed_loop();
    run["closed_loop"]["hover_at_rest_mean"] = hover;
    for (Json& old : results["runs"])
      if (old.at("detector") == detector) old["detector"] = "elsewhere";
    results["runs"].push_back(run);
  }
  Json reproduction = reproduce(results::from_json(results), tables());
  return scene_of(reproduction).at("hover_at_rest");
}

TEST(Reproduction, HoverAtRestIsThatOfBothAndTheirQuotient) {
  const Json hover = with_hover(0.125, 0.0625);
  EXPECT_EQ(hover.at("ffd-grid"), 0.125);
  EXPECT_EQ(hover.at("ffd-aabb-sphere2"), 0.0625);
  EXPECT_EQ(hover.at("factor"), 2.0);
  EXPECT_TRUE(with_hover(0.125, 0.0).at("factor").is_null());
  EXPECT_TRUE(with_hover(nullptr, 0.0625).is_null());
}

Json two_scenes() {
  Json results = sample_reproduction_results();
  Json scene = results.at("scenes").at(0);
  scene["id"] = "paper-t";
  results["scenes"].push_back(scene);
  // 12 to 4 ms (3x), totals of 16 to 8 ms (2x).
  for (const auto& [detector, test] : {std::pair{"ffd-aabb-sphere:bounds=safe", 12.0},
                                       std::pair{"ffd-aabb-sphere2:bounds=safe", 4.0}}) {
    Json run =
        sample_run(detector, sample_step_ms({.test_by_repeat = {test, test, test}}), "0xa", 0);
    run["scene"] = "paper-t";
    results["runs"].push_back(run);
  }
  return results;
}

// Of the second scene the paper reports collision tests of 80 and 10 ms, 100 and 30 ms in all.
PaperTables tables_of_two_scenes() {
  PaperTables paper = tables();
  PaperScene scene = paper.scenes.at(0);
  scene.id = "t";
  paper.scenes.push_back(scene);
  paper.table_3.rows.push_back({"t", "ffd-aabb-sphere", 5, 5, 80, 5, 100});
  paper.table_3.rows.push_back({"t", "ffd-aabb-sphere2", 5, 5, 10, 5, 30});
  paper.claims.frame_rate_gain.value = 34.44;
  return paper;
}

TEST(Reproduction, MeansAreGeometricForTestsAndArithmeticForFrameRates) {
  const Json means =
      reproduce(results::from_json(two_scenes()), tables_of_two_scenes()).at("means");
  EXPECT_EQ(means.at("scenes"), 2);
  EXPECT_DOUBLE_EQ(means.at("test_ratio").at("ours").get<double>(), std::sqrt(1.5 * 3.0));
  EXPECT_DOUBLE_EQ(means.at("test_ratio").at("paper").get<double>(), std::sqrt(2.0 * 8.0));
  const Json& rate = means.at("frame_rate_ratio");
  EXPECT_DOUBLE_EQ(rate.at("ours").get<double>(), (1.25 + 2.0) / 2.0);
  EXPECT_DOUBLE_EQ(rate.at("paper").get<double>(), (1.5 + 100.0 / 30.0) / 2.0);
  EXPECT_DOUBLE_EQ(rate.at("paper_claims").get<double>(), 1.3444);
}

TEST(Reproduction, MeansCountOnlyScenesThatWereTimed) {
  Json results = two_scenes();
  results["runs"].back()["status"] = "refused";
  const Json means = reproduce(results::from_json(results), tables_of_two_scenes()).at("means");
  EXPECT_EQ(means.at("scenes"), 1);
  EXPECT_DOUBLE_EQ(means.at("test_ratio").at("ours").get<double>(), 1.5);
  EXPECT_DOUBLE_EQ(means.at("test_ratio").at("paper").get<double>(), 2.0);
}

}  // namespace
}  // namespace contactcheck::reproduce
