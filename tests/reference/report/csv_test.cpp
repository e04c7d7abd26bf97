#include "reference/report/csv.h"

#include <gmock/gmock.h>

#include <map>
#include <sstream>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using results::from_json;
using test::sample_results;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// Of texts without quotes.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (char c : line)
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  return cells;
}

// The cells of one line that are not empty, by title.
std::map<std::string, std::string> row(const std::string& csv, std::size_t number) {
  std::istringstream lines(csv);
  std::string titles, line;
  std::getline(lines, titles);
  for (std::size_t i = 0; i <= number; ++i) std::getline(lines, line);
  const auto names = cells_of(titles), cells = cells_of(line);
  EXPECT_EQ(names.size(), cells.size());
  std::map<std::string, std::string> out;
  for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i)
    if (!cells[i].empty()) out[names[i]] = cells[i];
  return out;
}

TEST(Csv, RowHasWhatWasMeasuredAndEmptyCellsForTheRest) {
  const std::map<std::string, std::string> expected = {
      {"scene", "hello"},
      {"detector", "ffd-aabb-sphere2+tri"},
      {"status", "ok"},
      {"frames", "60"},
      {"contact_frames", "13"},
      {"finest_level", "triangle"},
      {"body_truth", "13"},
      {"body_reported", "15"},
      {"body_hit", "13"},
      {"body_missed", "0"},
      {"body_spurious", "2"},
      {"body_recall", "1.0"},
      {"body_spurious_rate", "0.13333333333333333"},
      {"triangle_truth", "200000"},
      {"triangle_reported", "200001"},
      {"triangle_hit", "199999"},
      {"triangle_missed", "1"},
      {"triangle_spurious", "2"},
      {"triangle_recall", "0.999995"},
      {"triangle_spurious_rate", "9.99995e-06"},
      {"hover_gap_max_m", "0.0021"},
      {"late_frames", "-1"},
      {"question", "triangles"},
      {"timed_frames", "60"},
      {"passes", "5"},
      {"prepare_ms", "8.0"},
      {"playback_update_ms", "0.125"},
      {"playback_query_ms", "0.375"},
      {"playback_frame_ms", "0.5"},
      {"playback_first_frame_ms", "1.0"},
      {"playback_cpu_ms", "0.5"},
      {"cold_update_ms", "0.25"},
      {"cold_query_ms", "0.5"},
      {"cold_frame_ms", "0.75"},
      {"cold_cpu_ms", "0.75"},
      {"vs_fcl-aabb_playback_ratio", "4.0"},
      {"vs_fcl-aabb_playback_low", "3.5"},
      {"vs_fcl-aabb_playback_high", "4.25"},
      {"vs_fcl-aabb_cold_ratio", "4.0"},
      {"vs_fcl-aabb_cold_low", "3.0"},
      {"vs_fcl-aabb_cold_high", "5.0"},
      {"vs_fcl-aabb_passes", "5"},
      {"prepared_bytes", "262144"},
      {"memory_bytes", "524288"},
      {"contact_hash", "0x2"}};
  EXPECT_EQ(row(csv_report(from_json(sample_results())), 1), expected);
}

TEST(Csv, HasADetectorsOwnClock) {
  auto results = sample_results();
  results["runs"][1]["time_ms"]["playback"]["self_reported"] = 0.125;
  const auto cells = row(csv_report(from_json(results)), 1);
  EXPECT_EQ(cells.at("playback_self_reported_ms"), "0.125");
}

// A time and the speed-ups beside it are of one question.
TEST(Csv, TimesAreOfTheQuestionOfTheSpeedups) {
  auto results = sample_results();
  auto& run = results["runs"][1];
  run["semantics"]["questions"] = {"cells", "body"};
  run["time_ms"]["question"] = "cells";
  auto body = run["time_ms"];
  body["question"] = "body";
  body["playback"]["frame"] = 0.625;
  body.erase("cold");
  run["time_ms_other_questions"] = {body};
  auto cells = row(csv_report(from_json(results)), 1);
  EXPECT_EQ(cells.at("question"), "body");
  EXPECT_EQ(cells.at("playback_frame_ms"), "0.625");
  EXPECT_FALSE(cells.contains("cold_frame_ms")) << "of its own question alone";
  run.erase("time_ms_other_questions");
  cells = row(csv_report(from_json(results)), 1);
  EXPECT_EQ(cells.at("question"), "cells");
  EXPECT_EQ(cells.at("playback_frame_ms"), "0.5");
}

TEST(Csv, RowThatIsNotOkHasStatusAndMessage) {
  const std::map<std::string, std::string> expected = {
      {"scene", "hello"}, {"detector", "embree"}, {"status", "absent"}, {"message", "not built"}};
  EXPECT_EQ(row(csv_report(from_json(sample_results())), 3), expected);
}

TEST(Csv, OptionsAreOneCell) {
  auto results = sample_results();
  results["runs"][0]["options"] = {{"margin", "0.001"}};
  EXPECT_EQ(row(csv_report(from_json(results)), 0).at("options"), "margin=0.001");
  results["runs"][0]["options"]["scale"] = "100";
  EXPECT_THAT(csv_report(from_json(results)),
              HasSubstr("\r\nhello,fcl-aabb,ok,,\"margin=0.001, scale=100\",60,"));
}

TEST(Csv, CommasQuotesAndLineEndsAreQuoted) {
  auto results = sample_results();
  results["runs"][3]["message"] = "a, \"b\"\nc";
  EXPECT_THAT(csv_report(from_json(results)),
              HasSubstr("\r\nhello,embree,absent,\"a, \"\"b\"\"\nc\",,"));
}

TEST(Csv, LinesEndInCrLfAndStartWithTheTitles) {
  auto results = sample_results();
  results["runs"] = nlohmann::ordered_json::array();
  const std::string titles = csv_report(from_json(results));
  EXPECT_THAT(titles, StartsWith("scene,detector,status,message,options,frames,contact_frames,"
                                 "finest_level,body_truth,body_reported,"));
  EXPECT_THAT(titles,
              EndsWith(",cold_cpu_ms,prepared_bytes,memory_bytes,contact_hash,recording\r\n"));
  EXPECT_EQ(std::count(titles.begin(), titles.end(), '\n'), 1);
}

}  // namespace
}  // namespace contactcheck::report
