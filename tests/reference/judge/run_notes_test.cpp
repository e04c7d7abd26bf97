#include "reference/judge/run_notes.h"

#include <gmock/gmock.h>

namespace contactcheck::judge {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FrameNotes, CountTheFramesOfEachSentence) {
  FrameNotes notes;
  notes.add_frame({"late"});
  notes.add_frame({});
  notes.add_frame({"early", "late"});
  EXPECT_THAT(notes.summary(), ElementsAre("late (in 2 of 3 frames)", "early (in 1 of 3 frames)"));
}

TEST(FrameNotes, AreSilentWhenNothingIsSaid) {
  FrameNotes notes;
  notes.add_frame({});
  EXPECT_THAT(notes.summary(), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::judge
