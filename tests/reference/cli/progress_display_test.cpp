#include "reference/cli/progress_display.h"

#include <gtest/gtest.h>

namespace contactcheck::cli {
namespace {

suite::SuiteProgress in_frame_twelve() {
  suite::SuiteProgress progress;
  progress.scene_id = "bunny-touch";
  progress.detector = "fcl-aabb";
  progress.frame = 11;
  progress.frames = 60;
  progress.share = 0.25;
  return progress;
}

TEST(ProgressLine, NamesShareTimeLeftSceneFrameAndDetector) {
  EXPECT_EQ(progress_line(in_frame_twelve(), 83.4, 100),
            "[#####...............]  25 %  1:23 left  bunny-touch  frame 12 of 60  fcl-aabb");
}

TEST(ProgressLine, LeavesOutWhatIsNotKnown) {
  suite::SuiteProgress progress = in_frame_twelve();
  progress.detector = "";
  progress.frame.reset();
  EXPECT_EQ(progress_line(progress, std::nullopt, 100),
            "[#####...............]  25 %  bunny-touch");
}

TEST(ProgressLine, EndsAtTheTerminalsEdge) {
  EXPECT_EQ(progress_line(in_frame_twelve(), 3600.0, 45),
            "[#####...............]  25 %  1:00:00 left  b");
}

TEST(SecondsLeft, FollowFromWhatWasDoneSinceTheStart) {
  EXPECT_EQ(seconds_left(10.0, 0.0, 0.25), 30.0);
  EXPECT_EQ(seconds_left(10.0, 0.5, 0.75), 10.0) << "half of it is an earlier run's";
  EXPECT_EQ(seconds_left(10.0, 0.0, 1.0), 0.0);
}

TEST(SecondsLeft, AreNotKnownAtTheBeginning) {
  EXPECT_EQ(seconds_left(1.0, 0.0, 0.5), std::nullopt);
  EXPECT_EQ(seconds_left(100.0, 0.0, 0.0), std::nullopt);
  EXPECT_EQ(seconds_left(100.0, 0.5, 0.51), std::nullopt);
}

}  // namespace
}  // namespace contactcheck::cli
