#include "reference/cli/event_lines.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::Outcome;

TEST(EventLines, ProgressNamesDetectorAndFrameOrNull) {
  suite::SuiteProgress progress;
  progress.scene_id = "tiny";
  progress.frames = 60;
  progress.share = 0.25;
  EXPECT_EQ(progress_event(progress, std::nullopt),
            R"({"event":"progress","scene":"tiny","detector":null,"frame":null,"of":60,)"
            R"("share":0.25,"seconds_left":null})");
  progress.detector = "fcl-aabb";
  progress.frame = 11;
  EXPECT_EQ(progress_event(progress, 7.5),
            R"({"event":"progress","scene":"tiny","detector":"fcl-aabb","frame":11,"of":60,)"
            R"("share":0.25,"seconds_left":7.5})");
}

TEST(EventLines, SceneHasTheStatusOfEachRow) {
  std::vector<results::Run> runs(2);
  runs[0].detector = "a";
  runs[1].detector = "b";
  runs[1].status = results::Status::kError;
  runs[1].message = "signal\n11";
  EXPECT_EQ(scene_event({"tiny", true, runs}),
            R"({"event":"scene","scene":"tiny","resumed":true,"runs":[)"
            R"({"detector":"a","status":"ok","message":""},)"
            R"({"detector":"b","status":"error","message":"signal\n11"}]})");
}

// Every line of a run's standard output, which must hold nothing else.
std::vector<Json> events_of(const std::string& out) {
  std::vector<Json> events;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) events.push_back(Json::parse(line));
  return events;
}

class JsonLines : public testing::Test {
 protected:
  JsonLines() {
    first_ = scratch_.write("first.json", test::tiny_scene("first"));
    second_ = scratch_.write("second.json", test::tiny_scene("second", "7"));
  }
  Outcome run(std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"run",          first_,       second_,    "--no-timing",
                                      "--json-lines", "--detector", "ffd-grid", "--detector",
                                      "fcl-aabb",     "--out",      out_};
    words.insert(words.end(), more.begin(), more.end());
    return contactcheck_program(words);
  }

  test::Scratch scratch_;
  std::string first_, second_, out_ = (scratch_.folder() / "out").string();
};

TEST_F(JsonLines, TellStartScenesAndEndInTheirOrder) {
  const Outcome outcome = run({"--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const std::vector<Json> events = events_of(outcome.out);
  std::string order;
  for (const Json& event : events) {
    const auto kind = event.at("event").get<std::string>();
    if (!order.ends_with(kind + " ")) order += kind + " ";
  }
  EXPECT_EQ(order, "start progress scene progress scene end ");
  const Json detectors = {"ffd-grid", "fcl-aabb"};
  EXPECT_EQ(events.front().at("schema"), "contactcheck-events/1");
  EXPECT_EQ(events.front().at("scenes"),
            Json({{{"scene", "first"}, {"frames", 5}, {"detectors", detectors}},
                  {{"scene", "second"}, {"frames", 7}, {"detectors", detectors}}}));
  EXPECT_EQ(events.back(), Json({{"event", "end"},
                                 {"out", out_},
                                 {"results", out_ + "/results.json"},
                                 {"exit_code", 0}}));
}

TEST_F(JsonLines, ProgressStaysWithinItsSceneAndNeverGoesBack) {
  double share = 0.0;
  for (const Json& event : events_of(run().out)) {
    if (event.at("event") != "progress") continue;
    EXPECT_EQ(event.at("of"), event.at("scene") == "first" ? 5 : 7);
    if (!event.at("frame").is_null()) {
      EXPECT_LT(event.at("frame"), event.at("of"));
    }
    EXPECT_GE(event.at("share"), share);
    share = event.at("share");
  }
}

TEST_F(JsonLines, SceneHasItsRowsAlsoWhereADetectorIsRefused) {
  const std::string plain = scratch_
                                .write("plain.json", R"({"id": "plain", "frames": 2,
    "duration": 1, "levels": ["triangle"], "bodies": [{"name": "a", "mesh": {"shape": "box"}},
    {"name": "b", "mesh": {"shape": "box", "center": [0.9, 0.1, 0.1]}}]})")
                                .string();
  const Outcome outcome = contactcheck_program(
      {"run", plain, "--no-timing", "--json-lines", "--detector", "ffd-grid", "--out", out_});
  const std::vector<Json> events = events_of(outcome.out);
  const Json& scene = events.at(events.size() - 2);
  EXPECT_EQ(scene.at("event"), "scene");
  EXPECT_EQ(scene.at("runs").at(0).at("detector"), "ffd-grid");
  EXPECT_EQ(scene.at("runs").at(0).at("status"), "refused");
  EXPECT_NE(scene.at("runs").at(0).at("message"), "");
}

TEST_F(JsonLines, RefusedInputTellsNothing) {
  const Outcome outcome = run({"--detector", "nobody"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::HasSubstr("nobody"));
}

}  // namespace
}  // namespace contactcheck::cli
