#include "reference/report/scene_tables.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/results/results_json.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

const Json kScene = {{"size", 2.0},
                     {"sweep", {{"separations", {-0.05, 0.0, 0.5}}, {"orientations", 3}}}};

Json run_of(const char* detector) {
  return {{"detector", detector},
          {"status", "ok"},
          {"time_ms", {{"question", "triangles"}, {"passes", 3}}},
          {"per_frame",
           {{"missed", {1, 2, 3, 0, 4, 0, 0, 0, 0}},
            {"spurious", {0, 0, 0, 0, 0, 0, 5, 0, 6}},
            {"frame_ms", {3.0, 1.0, 2.0, nullptr, 0.5, nullptr, nullptr, nullptr, nullptr}}}}};
}

std::string sweep_tables(const Json& scene, std::vector<Json> runs) {
  const results::Results results =
      results::from_json({{"scenes", Json::array({scene})}, {"runs", std::move(runs)}});
  const results::Index index(results);
  std::string out;
  for (const TitledTable& table : separation_tables(results.scenes[0], index.runs_of("")))
    out += markdown_of(table);
  return out;
}

TEST(SeparationTables, HaveMediansOfTimesAndSumsOfErrorsBySeparation) {
  const std::string tables = sweep_tables(kScene, {run_of("fcl-aabb")});
  EXPECT_THAT(tables, HasSubstr("3 orientations at each separation, given in % of the size (2"));
  EXPECT_THAT(tables, HasSubstr("| detector | -5 % | 0 % | 50 % | passes |"));
  EXPECT_THAT(tables, HasSubstr("| fcl-aabb | 2.00 | 0.500 | - | 3 |"));
  EXPECT_THAT(tables, HasSubstr("| fcl-aabb | 6 / 0 | 4 / 0 | 0 / 11 |"));
}

TEST(SeparationTables, LeaveOutWhatWasNotTimedOrDidNotRun) {
  Json untimed = run_of("a"), refused = run_of("b");
  untimed["per_frame"].erase("frame_ms");
  refused["status"] = "refused";
  const std::string tables = sweep_tables(kScene, {untimed, refused});
  EXPECT_THAT(tables, Not(HasSubstr("Time of a frame")));
  EXPECT_THAT(tables, HasSubstr("| a | 6 / 0 |"));
  EXPECT_THAT(tables, Not(HasSubstr("| b |")));
  EXPECT_EQ(sweep_tables({{"size", 2.0}}, {run_of("a")}), "");
}

}  // namespace
}  // namespace contactcheck::report
