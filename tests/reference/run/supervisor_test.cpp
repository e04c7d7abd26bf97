#include "reference/run/supervisor.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck {
namespace {

using test::Scratch;
using testing::HasSubstr;
using testing::Optional;

// A sanitizer's shadow alone takes tens of MiB.
constexpr std::uint64_t kMemoryLimit = std::uint64_t{300} << 20;

RunSettings limits(double seconds) {
  RunSettings settings;
  settings.call_limit = seconds;
  settings.memory_limit = kMemoryLimit;
  return settings;
}

WorkerOutcome outcome_of(const std::string& what, double seconds = 20.0) {
  const Scratch scratch;
  return run_supervised(CONTACTCHECK_FAKE_WORKER, scratch.write("job", what), limits(seconds),
                        [](double, std::optional<std::uint32_t>) {});
}

void expect_booked_on_detector_one(const WorkerOutcome& outcome) {
  EXPECT_FALSE(outcome.done);
  EXPECT_THAT(outcome.detector, Optional(1u));
  EXPECT_EQ(outcome.frame, 7u);
  EXPECT_EQ(outcome.phase, Phase::kUpdate);
}

TEST(Supervisor, AnsweringWorkerIsDone) {
  const WorkerOutcome outcome = outcome_of("answer");
  EXPECT_TRUE(outcome.done);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.reason, "");
}

TEST(Supervisor, CrashNamesSignalDetectorFrameAndPhase) {
  const WorkerOutcome outcome = outcome_of("crash");
  expect_booked_on_detector_one(outcome);
  EXPECT_EQ(outcome.reason, "signal 11 (Segmentation fault)");
}

TEST(Supervisor, AbortIsItsOwnSignal) {
  const WorkerOutcome outcome = outcome_of("abort");
  expect_booked_on_detector_one(outcome);
  EXPECT_EQ(outcome.reason, "signal 6 (Aborted)");
}

TEST(Supervisor, HangIsStoppedAndNamesTheLimit) {
  const WorkerOutcome outcome = outcome_of("hang", 0.25);
  expect_booked_on_detector_one(outcome);
  EXPECT_EQ(outcome.reason, "no progress for 0.25 s (time limit of one call)");
}

TEST(Supervisor, SteadyStepsAreNoHangHoweverLongTheyTake) {
  EXPECT_TRUE(outcome_of("slowly", 0.5).done);
}

TEST(Supervisor, MemoryBeyondTheLimitIsStoppedAndNamed) {
  const WorkerOutcome outcome = outcome_of("allocate");
  expect_booked_on_detector_one(outcome);
  EXPECT_EQ(outcome.reason, "more than 300 MiB resident (memory limit)");
}

TEST(Supervisor, ExitCodeOfAWorkerThatRefusesIsKept) {
  const WorkerOutcome outcome = outcome_of("refuse");
  EXPECT_FALSE(outcome.done);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.reason, "exit code 2");
}

TEST(Supervisor, LeavingWithoutAnAnswerIsNotDone) {
  const WorkerOutcome outcome = outcome_of("leave");
  expect_booked_on_detector_one(outcome);
  EXPECT_EQ(outcome.reason, "exit code 0");
}

TEST(Supervisor, CrashAfterTheAnswerIsDone) { EXPECT_TRUE(outcome_of("crash late").done); }

TEST(Supervisor, CrashOutsideDetectorsIsBookedOnNone) {
  const WorkerOutcome outcome = outcome_of("outside");
  EXPECT_FALSE(outcome.done);
  EXPECT_EQ(outcome.detector, std::nullopt);
  EXPECT_EQ(outcome.frame, 3u);
  EXPECT_EQ(outcome.phase, Phase::kTruth);
}

TEST(Supervisor, MissingProgramIsASentence) {
  const std::string sentence = test::sentence_of([] {
    run_supervised("/nonexistent/worker", "job", limits(1.0),
                   [](double, std::optional<std::uint32_t>) {});
  });
  EXPECT_THAT(sentence, HasSubstr("/nonexistent/worker"));
  EXPECT_THAT(sentence, HasSubstr("No such file"));
}

TEST(Supervisor, ReportsProgressWhileTheWorkerRuns) {
  const Scratch scratch;
  bool half_in_detector_one = false;
  run_supervised(CONTACTCHECK_FAKE_WORKER, scratch.write("job", "slowly"), limits(20.0),
                 [&](double share, std::optional<std::uint32_t> detector) {
                   if (share == 0.5 && detector == 1u) half_in_detector_one = true;
                 });
  EXPECT_TRUE(half_in_detector_one);
}

constexpr const char* kScene = R"({"id": "tiny", "frames": 3, "duration": 1, "levels": ["triangle"],
  "bodies": [{"name": "a", "mesh": {"shape": "box"}},
             {"name": "b", "mesh": {"shape": "box", "center": [0.9, 0.1, 0.1]}}]})";

Job job_in(const Scratch& scratch, const std::filesystem::path& scene) {
  Job job;
  job.scene_file = scene;
  job.settings.detectors = {"fcl-aabb"};
  job.settings.timing = false;
  job.answer_file = scratch.folder() / "answer";
  return job;
}

TEST(Supervisor, RealWorkerWritesItsAnswer) {
  const Scratch scratch;
  const Job job = job_in(scratch, scratch.write("tiny.json", kScene));
  write_job(scratch.folder() / "job", job);
  const WorkerOutcome outcome =
      run_supervised(CONTACTCHECK_PROGRAM, scratch.folder() / "job", RunSettings{},
                     [](double, std::optional<std::uint32_t>) {});
  ASSERT_TRUE(outcome.done) << outcome.reason;
  const auto answer = nlohmann::json::parse(read_text_file(job.answer_file));
  EXPECT_EQ(answer.at("scene").at("id"), "tiny");
  EXPECT_EQ(answer.at("runs").at(0).at("run").at("status"), "ok");
  EXPECT_EQ(answer.at("runs").at(0).at("run").at("levels").at("triangle").at("missed"), 0);
  EXPECT_GT(answer.at("scene").at("truth").at("triangle"), 0);
}

TEST(Supervisor, RealWorkerWithoutItsSceneExitsWithTwoOutsideAnyDetector) {
  const Scratch scratch;
  write_job(scratch.folder() / "job", job_in(scratch, scratch.folder() / "missing.json"));
  const WorkerOutcome outcome =
      run_supervised(CONTACTCHECK_PROGRAM, scratch.folder() / "job", RunSettings{},
                     [](double, std::optional<std::uint32_t>) {});
  EXPECT_FALSE(outcome.done);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.detector, std::nullopt);
  EXPECT_EQ(outcome.phase, Phase::kScene);
}

}  // namespace
}  // namespace contactcheck
