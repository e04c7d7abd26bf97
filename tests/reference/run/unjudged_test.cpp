// A real worker that is told that the oracle cannot judge its scene.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/run/job.h"
#include "reference/run/supervisor.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck {
namespace {

using test::Scratch;
using testing::IsEmpty;

nlohmann::json answer_of(const Scratch& scratch, std::size_t process) {
  Job job;
  job.scene_file = scratch.write("tiny.json", test::tiny_scene());
  job.settings.detectors = {"ffd-lazy", "fcl-aabb"};
  job.process = process;
  job.unjudged = Unjudged{"the oracle, frame 3", 3};
  job.answer_file = scratch.folder() / "answer";
  job.recording_file = scratch.folder() / "tiny.ccr";
  write_job(scratch.folder() / "job", job);
  const WorkerOutcome outcome = run_supervised(CONTACTCHECK_PROGRAM, scratch.folder() / "job",
                                               job.settings, [](const WorkerProgress&) {});
  EXPECT_TRUE(outcome.done) << outcome.error_text;
  return nlohmann::json::parse(read_text_file(job.answer_file));
}

void expect_errors_and_nothing_else(std::size_t process) {
  const Scratch scratch;
  const nlohmann::json answer = answer_of(scratch, process);
  EXPECT_FALSE(answer.contains("truth_contacts"));
  EXPECT_THAT(answer.at("contact_frames"), IsEmpty());
  EXPECT_EQ(answer.at("scene").at("frames"), 5);
  EXPECT_THAT(answer.at("scene").at("truth"), IsEmpty());
  EXPECT_EQ(answer.at("scene").at("unjudged"), "the oracle, frame 3");
  EXPECT_FALSE(std::filesystem::exists(scratch.folder() / "tiny.ccr"));
  ASSERT_EQ(answer.at("runs").size(), 2u);
  for (const auto& entry : answer.at("runs")) {
    EXPECT_EQ(entry.at("run").at("status"), "error");
    EXPECT_EQ(entry.at("run").at("message"), "the oracle, frame 3");
    EXPECT_EQ(entry.at("run").at("failed_frame"), 3);
    EXPECT_THAT(entry.at("samples"), IsEmpty());
  }
}

TEST(Unjudged, DetectorsEndInTheErrorOfTheOracle) { expect_errors_and_nothing_else(0); }

TEST(Unjudged, ProcessesThatOnlyTimeHaveNothingToTime) { expect_errors_and_nothing_else(1); }

}  // namespace
}  // namespace contactcheck
