#include "reference/gate/baseline.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "reference/results/results_json.h"
#include "tests/reference/gate/gate_world.h"

namespace contactcheck::gate {
namespace {

using Json = nlohmann::ordered_json;
using test::row_of;
using testing::ElementsAre;
using testing::IsEmpty;

results::Results sample() { return results::from_json(test::sample_results()); }

results::Run& row_in(results::Results& results, const std::string& scene,
                     const std::string& detector) {
  for (results::Run& row : results.runs)
    if (row.scene == scene && row.detector == detector) return row;
  throw std::out_of_range(detector);
}

TEST(Baseline, KeepsWhatAGateComparesAndPointsAtNoFile) {
  results::Results whole = sample();
  whole.resumed = {"touch"};
  whole.disagreements = {{"touch", "paper", "cell", "missed", "cases/1.json", 5}};
  row_in(whole, "touch", "exact").recording = "recordings/touch.ccr";
  Json expected = results::to_json(sample()), baseline = results::to_json(baseline_of(whole));
  EXPECT_EQ(baseline.at("disagreements"), Json::array());
  EXPECT_FALSE(baseline.contains("resumed"));
  for (const char* key : {"machine", "scenes", "libraries", "command"})
    EXPECT_EQ(baseline.at(key), expected.at(key)) << key;
  ASSERT_EQ(baseline.at("runs").size(), 8u);
  const Json &row = row_of(baseline, "touch", "exact"), &old = row_of(expected, "touch", "exact");
  EXPECT_EQ(row.at("recording"), "");
  EXPECT_EQ(row.at("per_frame").at("frame_ms"), Json::array());
  EXPECT_EQ(row.at("per_frame").at("truth").size(), 8u);
  for (const char* key : {"levels", "stages", "time_ms", "speedup", "memory_bytes", "contact_hash"})
    EXPECT_EQ(row.at(key), old.at(key)) << key;
  EXPECT_EQ(row_of(baseline, "touch", "lost"), row_of(expected, "touch", "lost"));
}

TEST(Baseline, LeavesOutWhatOnlyChartsShow) {
  results::Results whole = sample();
  whole.scenes[0].separation = {0.5, 0.0};
  results::Geometry& geometry = whole.runs[0].geometry;
  geometry.spurious_distance_histogram = geometry.depth.histogram =
      geometry.normal_deg.histogram = {{0.0, 1.0, 1}};
  geometry.episodes.resize(1);
  EXPECT_EQ(baseline_text(baseline_of(whole)), baseline_text(baseline_of(sample())));
}

TEST(Baseline, IsWrittenWithALinePerRow) {
  const results::Results baseline = baseline_of(sample());
  const std::string text = baseline_text(baseline);
  EXPECT_EQ(baseline_text(results::from_json(Json::parse(text))), text);
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("histogram")));
  EXPECT_THAT(text, testing::HasSubstr("\n  {\"scene\":\"touch\",\"detector\":\"lost\",\"status\":"
                                       "\"absent\",\"message\":\"not built\""));
  EXPECT_THAT(baseline_text({}), testing::HasSubstr("\n \"runs\": [],\n"));
}

TEST(BaselineChanges, OfTheSameAreNone) {
  EXPECT_THAT(baseline_changes(sample(), sample()), IsEmpty());
}

TEST(BaselineChanges, NameWhatIsNewGoneAndOther) {
  results::Results now = sample();
  now.machine.cpu = "B CPU";
  std::erase_if(now.libraries, [](const auto& library) { return library.first == "fcl"; });
  results::Run& paper = row_in(now, "touch", "paper");
  paper.levels.at(Level::kCell).missed = 4;
  paper.contact_hash = "0xdd";
  row_in(now, "touch", "exact").detector = "renamed";
  row_in(now, "touch", "broken").status = results::Status::kRefused;
  EXPECT_THAT(
      baseline_changes(sample(), now),
      ElementsAre("machine cpu A CPU -> B CPU", "library fcl 0.7.0 -> null", "touch  renamed: new",
                  "touch  paper: missed 3 -> 4, contact_hash 0xd -> 0xdd",
                  "touch  broken: status error -> refused", "touch  exact: gone"));
}

TEST(BaselineChanges, LeaveTimesOut) {
  results::Results now = sample();
  row_in(now, "touch", "exact").times.at(0).playback.frame = 9.0;
  EXPECT_THAT(baseline_changes(sample(), now), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::gate
