#include "reference/judge/run_notes.h"

#include <gmock/gmock.h>

namespace contactcheck::judge {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FrameNotes, CountTheFramesOfEachSentence) {
  FrameNotes notes;
  notes.add_frame({"late", "always"});
  notes.add_frame({"always"});
  notes.add_frame({"early", "late", "always"});
  EXPECT_THAT(notes.summary(),
              ElementsAre("late (in 2 of 3 frames)", "always", "early (in 1 of 3 frames)"));
}

TEST(FrameNotes, AreSilentWhenNothingIsSaid) {
  FrameNotes notes;
  notes.add_frame({});
  EXPECT_THAT(notes.summary(), IsEmpty());
}

TEST(ExchangedPairs, AreRecognisedFromHalfOfTheMissedOnesOn) {
  LevelComparison frame;
  frame.missed = {{0, 1, 3, 5}, {0, 1, 4, 9}};
  frame.spurious = {{0, 1, 5, 3}, {0, 1, 9, 4}};
  ExchangedPairs exchanged;
  EXPECT_EQ(exchanged.sentence(), "");
  exchanged.add_frame(frame);
  EXPECT_EQ(
      exchanged.sentence(),
      "reports all 2 missed pairs with a and b exchanged; a belongs to the body with the lower "
      "index");
  frame.spurious.pop_back();
  exchanged.add_frame(frame);
  EXPECT_THAT(exchanged.sentence(),
              testing::StartsWith("reports 3 of 4 missed pairs with a and b "));
  frame.spurious.clear();
  exchanged.add_frame(frame);
  EXPECT_THAT(exchanged.sentence(), testing::StartsWith("reports 3 of 6 "));
  exchanged.add_frame(frame);
  EXPECT_EQ(exchanged.sentence(), "");
}

}  // namespace
}  // namespace contactcheck::judge
