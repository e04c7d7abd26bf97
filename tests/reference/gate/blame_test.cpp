#include "reference/gate/blame.h"

#include <gmock/gmock.h>

#include "reference/results/results_json.h"
#include "tests/reference/gate/gate_world.h"

namespace contactcheck::gate {
namespace {

using Json = nlohmann::ordered_json;
using test::row_of;
using test::sample_results;

Rule rule_about(const char* measure, const std::string& level = "") {
  Rule rule;
  rule.measure = find_measure(measure);
  rule.level = level;
  return rule;
}

TEST(WorstFrame, OfAFamilyNamesTheValue) {
  Json results = sample_results();
  row_of(results, "hard-gap", "exact")["per_frame"]["missed"] = {0, 1, 0};
  const results::Results read = results::from_json(results);
  const results::Index index(read);
  EXPECT_EQ(worst_frame(rule_about("missed"), index, *index.run("hard-gap", "exact")),
            "frame 1 (1e-9)");
}

TEST(WorstFrame, OfEqualOnesIsTheFirst) {
  Json results = sample_results();
  row_of(results, "touch", "paper")["per_frame"]["missed"] = {0, 0, 4, 1, 4, 0, 0, 0};
  const results::Results read = results::from_json(results);
  const results::Index index(read);
  EXPECT_EQ(worst_frame(rule_about("missed"), index, *index.run("touch", "paper")), "frame 2");
}

TEST(WorstFrame, OfChangedContactsMayBeOneWithSpuriousOnes) {
  Json results = sample_results();
  row_of(results, "touch", "paper")["per_frame"]["missed"] = std::vector<int>(8, 0);
  const results::Results read = results::from_json(results);
  const results::Index index(read);
  EXPECT_EQ(worst_frame(rule_about("contact_hash"), index, *index.run("touch", "paper")),
            "frame 5");
}

TEST(WorstFrame, IsNotGuessedFromAnotherLevel) {
  const Json results = sample_results();
  const results::Results read = results::from_json(results);
  const results::Index index(read);
  EXPECT_EQ(worst_frame(rule_about("missed", "body"), index, *index.run("touch", "paper")), "");
}

std::string again(const Json& results, const std::string& scene, const std::string& detector,
                  const char* measure = "missed", Verdict verdict = Verdict::kFail) {
  const results::Results read = results::from_json(results);
  const results::Index index(read);
  Rule rule = rule_about(measure);
  rule.reference = "ref";
  return rerun_command(rule, index, *index.run(scene, detector), verdict);
}

TEST(RerunCommand, NamesTheFileThatTheRunNamed) {
  Json results = sample_results();
  EXPECT_EQ(again(results, "touch", "paper"),
            "contactcheck run scenes/touch.json --frames 8 --detector paper --no-timing");
  results["command"] = "contactcheck run default --out touch-out";
  EXPECT_EQ(again(results, "touch", "paper"),
            "contactcheck run touch --frames 8 --detector paper --no-timing");
  results["command"] = "contactcheck run out/recordings/touch.ccr";
  EXPECT_EQ(again(results, "touch", "paper"),
            "contactcheck run out/recordings/touch.ccr --detector paper --no-timing");
  results["command"] = "contactcheck run '/srv/Größe mit/touch.json' --out elsewhere";
  EXPECT_EQ(again(results, "touch", "paper"),
            "contactcheck run '/srv/Größe mit/touch.json' --frames 8 --detector paper --no-timing");
}

TEST(RerunCommand, OfAFamilyKeepsItsCases) {
  EXPECT_EQ(again(sample_results(), "hard-gap", "exact"),
            "contactcheck run hard-gap --detector exact --no-timing");
}

TEST(RerunCommand, OfRandomPairsMakesThemAgain) {
  EXPECT_EQ(again(sample_results(), "random-pairs", "exact"),
            "contactcheck run --pairs 64 --seed 7 --detector exact --no-timing");
}

TEST(RerunCommand, QuotesWhatAShellWouldTakeApart) {
  Json results = sample_results();
  row_of(results, "touch", "paper")["detector"] = "cmd:'x' y";
  EXPECT_EQ(again(results, "touch", "cmd:'x' y"),
            "contactcheck run scenes/touch.json --frames 8 --detector 'cmd:'\\''x'\\'' y' "
            "--no-timing");
  row_of(results, "touch", "exact")["detector"] = "ffd-aabb+tri:bounds=safe,isa=SSE4";
  EXPECT_EQ(again(results, "touch", "ffd-aabb+tri:bounds=safe,isa=SSE4"),
            "contactcheck run scenes/touch.json --frames 8 --detector "
            "ffd-aabb+tri:bounds=safe,isa=SSE4 --no-timing");
}

TEST(RerunCommand, OfATimingRuleRunsTheReferenceBesideIt) {
  const std::string command =
      "contactcheck run scenes/touch.json --frames 8 --detector exact --detector ref";
  Json results = sample_results();
  EXPECT_EQ(again(results, "touch", "exact", "speedup"), command + " --processes 7");
  EXPECT_EQ(again(results, "touch", "exact", "speedup", Verdict::kCannotJudge),
            command + " --processes 7");
  results["timing"]["processes"] = 3;
  EXPECT_EQ(again(results, "touch", "exact", "speedup"), command + " --processes 3");
  EXPECT_EQ(again(results, "touch", "exact", "speedup", Verdict::kCannotJudge),
            command + " --processes 5");
  results["timing"]["seed"] = 7;
  EXPECT_EQ(again(results, "touch", "exact", "speedup"), command + " --processes 3 --seed 7");
  results.erase("timing");
  EXPECT_EQ(again(results, "touch", "exact", "speedup"), command);
}

}  // namespace
}  // namespace contactcheck::gate
