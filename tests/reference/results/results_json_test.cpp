// The kept results of timed runs, read and written again.
#include "reference/results/results_json.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/results/results_file.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::results {
namespace {

using Json = nlohmann::ordered_json;

Json read(const std::string& file) {
  std::ifstream in(file);
  return Json::parse(in);
}

class KeptFile : public testing::TestWithParam<const char*> {};

TEST_P(KeptFile, IsTheSameWhenItIsReadAndWritten) {
  const Json json = read(GetParam());
  EXPECT_EQ(to_json(from_json(json)).dump(1), json.dump(1));
}

INSTANTIATE_TEST_SUITE_P(Results, KeptFile,
                         testing::Values(CONTACTCHECK_KEPT_RESULTS "/default.json",
                                         CONTACTCHECK_KEPT_RESULTS "/default-again.json",
                                         CONTACTCHECK_KEPT_RESULTS "/hard.json",
                                         CONTACTCHECK_KEPT_RESULTS "/simulated.json",
                                         CONTACTCHECK_KEPT_RESULTS "/shard1/results.json",
                                         CONTACTCHECK_KEPT_RESULTS "/shard2/results.json"));

// Files by hand or stripped leave out what may be missing; nothing that they have is lost.
TEST(SparseFile, WithLessThanARunWritesGetsDefaultsAndLosesNothing) {
  for (const char* file :
       {CONTACTCHECK_EXAMPLE_RESULTS, CONTACTCHECK_FIXTURES "/baselines/ci.json"}) {
    const Json json = read(file);
    // Without an order of members.
    const nlohmann::json before = json, after = to_json(from_json(json));
    for (const auto& change : nlohmann::json::diff(before, after))
      EXPECT_EQ(change.at("op"), "add") << file << ": " << change;
  }
}

TEST(FromJson, KeepsWhatARowSays) {
  const Results results = from_json(read(CONTACTCHECK_KEPT_RESULTS "/default.json"));
  const auto* const run = Index(results).run("contact", "ffd-lazy");
  ASSERT_NE(run, nullptr);
  EXPECT_EQ(run->levels.at(Level::kTriangle).missed, 0u);
  EXPECT_EQ(run->times.front().question, Question::kTriangles);
  EXPECT_GT(run->speedup.at(Question::kTriangles).at("fcl-aabb").playback.value, 1.0);
}

TEST(FromJson, KeepsTheTimeOfEachPassAndWhatWasTaken) {
  const Results results = from_json(read(CONTACTCHECK_EXAMPLE_RESULTS));
  const std::vector<QuestionTimes>& times = results.runs.at(0).times;
  ASSERT_EQ(times.size(), 2u);
  EXPECT_THAT(times[0].pass_ms, testing::ElementsAre(0.5, 0.25, 1.0, 0.4, 0.625));
  EXPECT_EQ(times[0].playback.taken, 0.125);
  // Of a program that did not keep them.
  EXPECT_TRUE(times[1].pass_ms.empty());
  EXPECT_EQ(times[1].playback.taken, std::nullopt);
}

TEST(FromJson, RefusesWhatIsOfAnotherTypeOrUnknown) {
  for (const char* text : {R"({"runs": [1]})", R"({"runs": [{"status": "fine"}]})",
                           R"({"runs": [{"status": "ok", "levels": {"edge": {}}}]})",
                           R"({"version": 7})", R"({"runs": [{"frames": "many"}]})"})
    EXPECT_THROW(from_json(Json::parse(text)), Json::exception) << text;
}

// What is missing has its default, which reads as nothing missed.
TEST(ResultsIn, RefusesWhereThereIsNoSchemaToCheckBy) {
  const test::Scratch scratch;
  EXPECT_EQ(results_in(CONTACTCHECK_KEPT_RESULTS "/default.json").scenes.size(), 3u);
  const test::Environment elsewhere("CONTACTCHECK_FIXTURES", scratch.folder().string());
  EXPECT_THAT([] { results_in(CONTACTCHECK_KEPT_RESULTS "/default.json"); },
              testing::ThrowsMessage<InputError>(testing::AllOf(
                  testing::HasSubstr("cannot be checked"),
                  testing::HasSubstr(scratch.folder().string() + "/results.schema.json"))));
}

}  // namespace
}  // namespace contactcheck::results
