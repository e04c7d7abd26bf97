#include "reference/gate/baseline.h"

#include <gmock/gmock.h>

#include "reference/results/results_json.h"
#include "tests/reference/gate/gate_world.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
using test::row_of;
using test::sample_results;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> changes(const Json& before, const Json& now) {
  return baseline_changes(results::from_json(before), results::from_json(now));
}

TEST(Baseline, KeepsWhatAGateComparesAndPointsAtNoFile) {
  Json baseline = baseline_of(sample_results());
  EXPECT_EQ(baseline.at("disagreements"), Json::array());
  EXPECT_EQ(baseline.at("machine"), sample_results().at("machine"));
  EXPECT_EQ(baseline.at("scenes"), sample_results().at("scenes"));
  ASSERT_EQ(baseline.at("runs").size(), 8u);
  const Json& row = row_of(baseline, "touch", "exact");
  EXPECT_EQ(row.at("recording"), "");
  EXPECT_EQ(row.at("per_frame").at("frame_ms"), Json::array());
  EXPECT_EQ(row.at("per_frame").at("truth").size(), 8u);
  EXPECT_FALSE(row.at("geometry").contains("episodes"));
  for (const char* key : {"levels", "stages", "time_ms", "speedup", "memory_bytes", "contact_hash"})
    EXPECT_EQ(row.at(key), sample_results().at("runs")[0].at(key)) << key;
  EXPECT_EQ(row_of(baseline, "touch", "lost"), sample_results().at("runs")[5]);
}

TEST(Baseline, LeavesOutWhatOnlyChartsShow) {
  Json results = sample_results();
  results["scenes"][0]["separation"] = {0.5, 0.0};
  Json& geometry = results["runs"][0]["geometry"];
  for (const char* key :
       {"depth_error_histogram", "normal_error_deg_histogram", "spurious_distance_histogram"})
    geometry[key] = Json::array({{{"from", 0.0}, {"below", 1.0}, {"count", 1}}});
  EXPECT_EQ(baseline_of(results), baseline_of(sample_results()));
}

TEST(Baseline, IsWrittenWithALinePerRow) {
  const Json baseline = baseline_of(sample_results());
  const std::string text = baseline_text(baseline);
  EXPECT_EQ(Json::parse(text), baseline);
  EXPECT_THAT(text, testing::HasSubstr("\n  {\"scene\":\"touch\",\"detector\":\"lost\",\"status\":"
                                       "\"absent\",\"message\":\"not built\"},\n"));
  EXPECT_THAT(baseline_text({{"runs", Json::array()}}), testing::Eq("{\n \"runs\": []\n}\n"));
}

TEST(BaselineChanges, OfTheSameAreNone) {
  const Json baseline = baseline_of(sample_results());
  EXPECT_THAT(changes(baseline, baseline), IsEmpty());
}

TEST(BaselineChanges, NameWhatIsNewGoneAndOther) {
  const Json before = baseline_of(sample_results());
  Json now = before;
  now["machine"]["cpu"] = "B CPU";
  now["libraries"].erase("fcl");
  Json& paper = row_of(now, "touch", "paper");
  paper["levels"]["cell"]["missed"] = 4;
  paper["contact_hash"] = "0xdd";
  row_of(now, "touch", "exact")["detector"] = "renamed";
  row_of(now, "touch", "broken")["status"] = "refused";
  EXPECT_THAT(
      changes(before, now),
      ElementsAre("machine cpu A CPU -> B CPU", "library fcl 0.7.0 -> null", "touch  renamed: new",
                  "touch  paper: missed 3 -> 4, contact_hash 0xd -> 0xdd",
                  "touch  broken: status error -> refused", "touch  exact: gone"));
}

TEST(BaselineChanges, LeaveTimesOut) {
  const Json before = baseline_of(sample_results());
  Json now = before;
  row_of(now, "touch", "exact")["time_ms"]["cold"]["frame"] = 9.0;
  EXPECT_THAT(changes(before, now), IsEmpty());
}

}  // namespace
}  // namespace contactcheck
