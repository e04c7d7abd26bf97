#include "reference/report/csv.h"

#include <gmock/gmock.h>

#include <map>
#include <sstream>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck {
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
      {"repeats", "5"},
      {"prepare_ms", "8.0"},
      {"cold_update_ms", "0.125"},
      {"cold_query_ms", "0.375"},
      {"cold_frame_ms", "0.5"},
      {"hot_update_ms", "0.125"},
      {"hot_query_ms", "0.125"},
      {"hot_frame_ms", "0.25"},
      {"speedup_question", "triangles"},
      {"vs_fcl-aabb_cold_ratio", "4.0"},
      {"vs_fcl-aabb_cold_low", "3.5"},
      {"vs_fcl-aabb_cold_high", "4.25"},
      {"vs_fcl-aabb_hot_ratio", "6.0"},
      {"vs_fcl-aabb_hot_low", "5.5"},
      {"vs_fcl-aabb_hot_high", "6.5"},
      {"memory_bytes", "524288"},
      {"contact_hash", "0x2"}};
  EXPECT_EQ(row(csv_report(from_json(sample_results())), 1), expected);
}

TEST(Csv, HasADetectorsOwnClock) {
  auto results = sample_results();
  results["runs"][1]["time_ms"]["hot"]["self_reported"] = 0.125;
  const auto cells = row(csv_report(from_json(results)), 1);
  EXPECT_EQ(cells.at("hot_self_reported_ms"), "0.125");
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
  EXPECT_THAT(titles, EndsWith(",speedup_question,memory_bytes,contact_hash,recording\r\n"));
  EXPECT_EQ(std::count(titles.begin(), titles.end(), '\n'), 1);
}

}  // namespace
}  // namespace contactcheck
