#include "reference/diff/result_table.h"

#include <gtest/gtest.h>

#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using test::sample_results;

TEST(ResultTable, HasWhatIsComparedOfARow) {
  const ResultTable table = read_table(sample_results());
  EXPECT_EQ(table.version, "0.1.0");
  EXPECT_EQ(table.rows.size(), 5u);
  const ResultRow* const row = table.find("hello", "ffd-aabb-sphere2+tri");
  ASSERT_NE(row, nullptr);
  EXPECT_EQ(row->levels.at("triangle"), (LevelRow{200000, 1, 2, false}));
  EXPECT_EQ(row->geometry.at("hover_gap_max"), 0.0021);
  EXPECT_EQ(row->geometry.at("late_frames"), -1.0);
  EXPECT_EQ(row->geometry.at("missed_length"), std::nullopt);
  EXPECT_EQ(row->contact_hash, "0x2");
  ASSERT_EQ(row->times.size(), 1u);
  EXPECT_EQ(row->times[0].question, "triangles");
  EXPECT_EQ(row->times[0].cold, 0.5);
  EXPECT_EQ(row->times[0].hot, 0.25);
  ASSERT_EQ(row->speedups.size(), 1u);
  EXPECT_EQ(row->speedups[0].first, "fcl-aabb");
  EXPECT_EQ(row->speedups[0].second.low, 3.5);
}

TEST(ResultTable, RowThatIsNotOkHasStatusAndMessageAlone) {
  const ResultTable table = read_table(sample_results());
  const ResultRow* const row = table.find("hello", "embree");
  ASSERT_NE(row, nullptr);
  EXPECT_EQ(row->status, "absent");
  EXPECT_EQ(row->message, "not built");
  EXPECT_TRUE(row->levels.empty());
}

TEST(ResultTable, RoundedTruthIsALevelOfItsOwn) {
  auto results = sample_results();
  results["runs"][0]["levels_rounded"]["triangle"] = results["runs"][1]["levels"]["triangle"];
  const ResultRow row = read_table(results).rows.at(0);
  EXPECT_EQ(row.levels.at("triangle").missed, 0u);
  EXPECT_EQ(row.levels.at("triangle rounded").missed, 1u);
}

TEST(ResultTable, MissingFieldIsAnException) {
  auto results = sample_results();
  results["runs"][0].erase("contact_hash");
  EXPECT_THROW(read_table(results), nlohmann::ordered_json::exception);
}

}  // namespace
}  // namespace contactcheck
