#include "reference/compare/run_result_json.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace contactcheck {
namespace {

RunResult hand_built() {
  RunResult run;
  run.scene = "hello";
  run.detector = "ffd-aabb-sphere2";
  run.frames = 2;
  run.contact_frames = 1;
  run.semantics.levels = {Level::kBody, Level::kCell};
  run.semantics.informative = {Level::kVertex};
  run.semantics.means = "cells that meet";
  run.semantics.questions = {Question::kCells, Question::kBody};
  run.options = {{"bounds", "paper"}};
  run.recording = "recordings/hello.ccr";
  run.per_frame = {"cell", {0, 4}, {0, 1}, {1, 0}, {std::nullopt, 0.75}};
  run.levels[Level::kBody] = {1, 2, 1, 0, 1};
  run.levels[Level::kCell] = {4, 0, 0, 4, 0};
  run.levels[Level::kVertex] = {2, 1, 1, 1, 0};
  run.not_judged[Level::kContainment] = "not judged: open";
  run.graded.missed_length = 0.125;
  run.graded.covered_length_fraction = 0.75;
  run.graded.depth = {4, 0.5, 0.25, 0.375, {{0.125, 0.25, 3}, {0.5, 1.0, 1}}};
  Episode episode;
  episode.bodies = {0, 1};
  episode.first_true = 1;
  episode.first_reported = 0;
  episode.hover_gap = 0.25;
  episode.late_frames = -1;
  run.episodes = {episode};
  run.stages = {{"hash", "cell pairs", 20, 8, 1, 33, "bucket entries"},
                {"node-plane", "cell pairs", 8, 8, 0, 0, ""}};
  run.prepare_ms = 1.5;
  run.memory_bytes = 4096;
  run.contact_hash = 0x0123456789abcdef;
  run.float_environment = {"update changed flush-to-zero"};
  run.notes = {"something odd"};
  return run;
}

TEST(RunResultJson, IsThisText) {
  EXPECT_EQ(to_json(hand_built()).dump(1), R"({
 "scene": "hello",
 "detector": "ffd-aabb-sphere2",
 "status": "ok",
 "message": "",
 "frames": 2,
 "contact_frames": 1,
 "semantics": {
  "levels": [
   "body",
   "cell"
  ],
  "informative": [
   "vertex"
  ],
  "questions": [
   "cells",
   "body"
  ],
  "body": "surface",
  "touching": "closed",
  "exact": false,
  "margin": 0.0,
  "precision": "double",
  "scale": 1.0,
  "depth_kind": "none",
  "means": "cells that meet"
 },
 "options": {
  "bounds": "paper"
 },
 "recording": "recordings/hello.ccr",
 "per_frame": {
  "level": "cell",
  "truth": [
   0,
   4
  ],
  "missed": [
   0,
   1
  ],
  "spurious": [
   1,
   0
  ],
  "covered_length_fraction": [
   null,
   0.75
  ]
 },
 "levels": {
  "body": {
   "truth": 1,
   "reported": 2,
   "hit": 1,
   "missed": 0,
   "spurious": 1,
   "recall": 1.0,
   "spurious_rate": 0.5
  },
  "cell": {
   "truth": 4,
   "reported": 0,
   "hit": 0,
   "missed": 4,
   "spurious": 0,
   "recall": 0.0,
   "spurious_rate": null
  },
  "vertex": {
   "truth": 2,
   "reported": 1,
   "hit": 1,
   "missed": 1,
   "spurious": 0,
   "recall": 0.5,
   "spurious_rate": 0.0,
   "informative": true
  }
 },
 "not_judged": {
  "containment": "not judged: open"
 },
 "geometry": {
  "missed_length": 0.125,
  "covered_length_fraction": 0.75,
  "spurious_distance_max": null,
  "spurious_distance_histogram": [],
  "depth_kind": "none",
  "depth_judged": 4,
  "depth_error_max": 0.5,
  "depth_error_mean": 0.25,
  "depth_error_p95": 0.375,
  "depth_error_histogram": [
   {
    "from": 0.125,
    "below": 0.25,
    "count": 3
   },
   {
    "from": 0.5,
    "below": 1.0,
    "count": 1
   }
  ],
  "normal_judged": 0,
  "normal_error_deg_max": null,
  "normal_error_deg_mean": null,
  "normal_error_deg_p95": null,
  "normal_error_deg_histogram": [],
  "hover_gap_max": 0.25,
  "late_frames": -1,
  "episodes": [
   {
    "bodies": [
     0,
     1
    ],
    "first_true": 1,
    "first_reported": 0,
    "hover_gap": 0.25,
    "late_frames": -1
   }
  ]
 },
 "stages": [
  {
   "name": "hash",
   "unit": "cell pairs",
   "in": 20,
   "out": 8,
   "missed": 1,
   "visited": 33,
   "visited_unit": "bucket entries"
  },
  {
   "name": "node-plane",
   "unit": "cell pairs",
   "in": 8,
   "out": 8,
   "missed": 0
  }
 ],
 "time_ms": {
  "prepare": 1.5
 },
 "memory_bytes": 4096,
 "contact_hash": "0x0123456789abcdef",
 "float_environment": [
  "update changed flush-to-zero"
 ],
 "notes": [
  "something odd"
 ]
})");
}

TEST(RunResultJson, NearNamesItsMarginAndRoundedLevelsStandApart) {
  RunResult run = hand_built();
  EXPECT_FALSE(to_json(run).contains("levels_rounded"));
  run.semantics.levels = {Level::kNear};
  run.semantics.margin = 0.002;
  run.semantics.precision = Precision::kSingle;
  run.semantics.scale = 64.0;
  run.levels = {{Level::kNear, {3, 3, 2, 1, 1}}};
  run.levels_rounded = {{Level::kNear, {3, 3, 3, 0, 0}}};
  const nlohmann::ordered_json json = to_json(run);
  EXPECT_EQ(json.at("levels").at("near").at("margin"), 0.002);
  EXPECT_EQ(json.at("levels").at("near").at("missed"), 1);
  EXPECT_FALSE(json.at("levels").at("near").contains("informative"));
  EXPECT_EQ(json.at("levels_rounded").at("near").at("missed"), 0);
  EXPECT_EQ(json.at("semantics").at("scale"), 64.0);
}

TEST(RunResultJson, SaysALocalOriginWhereThereIsOne) {
  RunResult run = hand_built();
  EXPECT_FALSE(to_json(run).at("semantics").contains("local_origin"));
  run.semantics.precision = Precision::kSingle;
  run.semantics.local_origin = true;
  EXPECT_EQ(to_json(run).at("semantics").at("local_origin"), true);
}

RunTimes hand_built_times() {
  QuestionTimes cells, body;
  cells.question = Question::kCells;
  cells.timed_frames = 1;
  cells.repeats = 5;
  cells.cold = {std::nullopt, 0.125, 0.25, 0.375, std::nullopt, std::nullopt};
  cells.hot = {0.5, 0.0625, 0.125, 0.6875, 0.75, std::nullopt};
  body.question = Question::kBody;
  Speedup speedup;
  speedup.cold = {2.0, 1.5, 2.5};
  speedup.hot = {4.0, 4.0, 4.0};
  speedup.contact_frames = Ratio{1.0, 0.5, 1.5};
  RunTimes times;
  times.questions = {cells, body};
  times.cold_frame_ms = {{1, 0.375}};
  times.speedups[Question::kBody]["fcl-aabb"] = speedup;
  return times;
}

TEST(RunResultJson, TimesCompleteAnOkRun) {
  auto run = to_json(hand_built());
  add_times(hand_built_times(), run);
  EXPECT_EQ(run.at("per_frame").at("frame_ms").dump(), "[null,0.375]");
  EXPECT_EQ(run.at("time_ms").dump(),
            R"({"prepare":1.5,"question":"cells","timed_frames":1,"timed_contact_frames":0,)"
            R"("repeats":5,)"
            R"("cold":{"map":null,"update":0.125,"query":0.25,"frame":0.375,"contact_frame":null},)"
            R"("hot":{"map":0.5,"update":0.0625,"query":0.125,"frame":0.6875,)"
            R"("contact_frame":0.75}})");
  ASSERT_EQ(run.at("time_ms_other_questions").size(), 1u);
  EXPECT_EQ(run.at("time_ms_other_questions")[0].at("question"), "body");
  EXPECT_EQ(run.at("speedup").dump(),
            R"({"body":{"fcl-aabb":{"cold":{"ratio":2.0,"low":1.5,"high":2.5},)"
            R"("hot":{"ratio":4.0,"low":4.0,"high":4.0},)"
            R"("contact_frames":{"ratio":1.0,"low":0.5,"high":1.5},"without_map":null}}})");
}

TEST(RunResultJson, RunThatIsNotOkHasNoLevelsAndNoTimes) {
  for (const RunStatus status : {RunStatus::kError, RunStatus::kAbsent, RunStatus::kRefused}) {
    RunResult run = hand_built();
    run.status = status;
    run.message = "why";
    const auto json = to_json(run);
    EXPECT_EQ(json.at("status"), name_of(status));
    EXPECT_EQ(json.at("message"), "why");
    for (const char* key :
         {"levels", "per_frame", "geometry", "stages", "time_ms", "contact_hash", "memory_bytes"})
      EXPECT_FALSE(json.contains(key)) << key << " of a run that is " << name_of(status);
  }
}

TEST(RunResultJson, StatusesAreTheWordsOfTheDesign) {
  EXPECT_STREQ(name_of(RunStatus::kOk), "ok");
  EXPECT_STREQ(name_of(RunStatus::kError), "error");
  EXPECT_STREQ(name_of(RunStatus::kAbsent), "absent");
  EXPECT_STREQ(name_of(RunStatus::kRefused), "refused");
}

TEST(RunResultJson, DisagreementIsThisText) {
  Disagreement d;
  d.scene = "hello";
  d.detector = "fcl-aabb";
  d.level = "triangle";
  d.kind = "missed";
  d.frame = 17;
  d.case_file = "cases/0001.json";
  EXPECT_EQ(to_json(d).dump(),
            R"({"scene":"hello","frame":17,"detector":"fcl-aabb","level":"triangle",)"
            R"("kind":"missed","case":"cases/0001.json"})");
}

TEST(Hex, HasSixteenDigits) {
  EXPECT_EQ(hex(0), "0x0000000000000000");
  EXPECT_EQ(hex(0xfedcba9876543210), "0xfedcba9876543210");
}

}  // namespace
}  // namespace contactcheck
