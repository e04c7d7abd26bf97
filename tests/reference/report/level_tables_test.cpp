#include "reference/report/tables/level_tables.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using Cells = std::vector<std::string>;

// A second scene, in which fcl-aabb ran alone.
results::Results results_of_two_scenes(Level level) {
  results::Results results = results::from_json(test::sample_results());
  results::Scene scene = results.scenes[0];
  results::Run run = results.runs[0];
  scene.id = run.scene = "second";
  run.per_frame.level = level;
  results.scenes.push_back(scene);
  results.runs.push_back(run);
  return results;
}

Cells cell_texts(const std::vector<HeatCell>& row) {
  Cells out;
  for (const HeatCell& cell : row) out.push_back(cell.text);
  return out;
}

TEST(LevelTables, OfOneSceneHaveNoSum) {
  const results::Results results = results::from_json(test::sample_results());
  const LevelTables tables = level_tables(results::Index(results), {});
  EXPECT_EQ(tables.recall.columns, (Cells{"detector", "hello"}));
  ASSERT_EQ(tables.recall.rows.size(), 5u);
  EXPECT_EQ(cell_texts(tables.recall.rows[0]), (Cells{"fcl-aabb", "1"}));
  EXPECT_EQ(cell_texts(tables.recall.rows[1]), (Cells{"ffd-aabb-sphere2+tri", "0.99999"}));
  EXPECT_EQ(cell_texts(tables.spurious.rows[1]), (Cells{"ffd-aabb-sphere2+tri", "0.00001"}));
  EXPECT_EQ(cell_texts(tables.recall.rows[2]), (Cells{"fcl-obbrss", "error"}));
  EXPECT_EQ(tables.recall.rows[2][1].kind, "error");
}

TEST(LevelTables, ShareOfMissedIsTheColourOfRecall) {
  const results::Results results = results::from_json(test::sample_results());
  const LevelTables tables = level_tables(results::Index(results), Level::kTriangle);
  const HeatCell& cell = tables.recall.rows[1][1];
  EXPECT_EQ(cell.share, 1.0 / 200'000);
  EXPECT_EQ(cell.label,
            "ffd-aabb-sphere2+tri in hello, level triangle: 200,000 true, 1 missed, 200,001 "
            "reported, 2 spurious");
  EXPECT_EQ(tables.spurious.rows[1][1].share, 2.0 / 200'001);
}

TEST(LevelTables, SumScenesOfOneLevel) {
  const results::Results results = results_of_two_scenes(Level::kTriangle);
  const LevelTables tables = level_tables(results::Index(results), {});
  EXPECT_EQ(tables.recall.columns, (Cells{"detector", "all scenes", "hello", "second"}));
  EXPECT_EQ(cell_texts(tables.recall.rows[0]), (Cells{"fcl-aabb", "1", "1", "1"}));
  EXPECT_EQ(tables.recall.rows[0][1].label,
            "fcl-aabb, all scenes: 400,000 true, 0 missed, 400,000 reported, 0 spurious");
  EXPECT_EQ(cell_texts(tables.recall.rows[1]),
            (Cells{"ffd-aabb-sphere2+tri", "0.99999", "0.99999", ""}));
}

TEST(LevelTables, CountsOfDifferentLevelsHaveNoSum) {
  const results::Results results = results_of_two_scenes(Level::kBody);
  const results::Index index(results);
  EXPECT_EQ(level_tables(index, {}).recall.rows[0][1].text, "levels differ");
  EXPECT_EQ(level_tables(index, Level::kBody).recall.rows[0][1].label,
            "fcl-aabb, all scenes: 26 true, 0 missed, 26 reported, 0 spurious");
}

TEST(LevelTables, LevelsThatAreNotClaimedAreNotThere) {
  results::Results results = results::from_json(test::sample_results());
  results.runs[1].levels[Level::kBody].informative = true;
  EXPECT_EQ(judged_levels(results), (std::vector{Level::kBody, Level::kTriangle}));
  const LevelTables tables = level_tables(results::Index(results), Level::kBody);
  // Its row is gone; those that did not end well stay.
  EXPECT_EQ(cell_texts(tables.recall.rows[1]), (Cells{"fcl-obbrss", "error"}));
  results.runs[0].levels.erase(Level::kBody);
  EXPECT_EQ(judged_levels(results), std::vector{Level::kTriangle});
}

}  // namespace
}  // namespace contactcheck::report
