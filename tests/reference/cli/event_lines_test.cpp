#include "reference/cli/event_lines.h"

#include <gtest/gtest.h>

namespace contactcheck::cli {
namespace {

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

}  // namespace
}  // namespace contactcheck::cli
