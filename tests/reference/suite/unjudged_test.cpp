// A real worker that is told that the oracle cannot judge its scene.
#include <gmock/gmock.h>

#include "reference/suite/job.h"
#include "reference/suite/supervisor.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::suite {
namespace {

using test::Scratch;
using testing::IsEmpty;

SceneAnswer answer_of(const Scratch& scratch) {
  Job job;
  job.scene = scratch.write("tiny.json", test::tiny_scene());
  job.settings.detectors = {"ffd-lazy", "fcl-aabb"};
  job.unjudged = Unjudged{"the oracle, frame 3", 3};
  job.answer_file = scratch.folder() / "answer";
  job.recording_file = scratch.folder() / "tiny.ccr";
  write_job(scratch.folder() / "job", job);
  const WorkerOutcome outcome = run_supervised(CONTACTCHECK_PROGRAM, scratch.folder() / "job",
                                               job.settings, [](const WorkerProgress&) {});
  EXPECT_TRUE(outcome.done) << outcome.error_text;
  return read_answer(job.answer_file);
}

TEST(Unjudged, DetectorsEndInTheErrorOfTheOracle) {
  const Scratch scratch;
  const SceneAnswer answer = answer_of(scratch);
  EXPECT_EQ(answer.truth_contacts, "");
  EXPECT_THAT(answer.contact_frames, IsEmpty());
  EXPECT_EQ(answer.scene.frames, 5u);
  EXPECT_THAT(answer.scene.truth, IsEmpty());
  EXPECT_EQ(answer.scene.unjudged, "the oracle, frame 3");
  EXPECT_FALSE(std::filesystem::exists(scratch.folder() / "tiny.ccr"));
  ASSERT_EQ(answer.detectors.size(), 2u);
  for (const DetectorAnswer& detector : answer.detectors) {
    EXPECT_EQ(detector.run.status, results::Status::kError);
    EXPECT_EQ(detector.run.message, "the oracle, frame 3");
    EXPECT_EQ(detector.run.failed_frame, 3u);
  }
}

}  // namespace
}  // namespace contactcheck::suite
