#include "reference/suite/supervisor.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <fstream>

#include "core/types/check.h"
#include "reference/process/interrupts.h"
#include "tests/reference/process/is_dead.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::suite {
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
                        [](const WorkerProgress&) {});
}

void expect_booked_on_detector_one(const WorkerOutcome& outcome) {
  EXPECT_FALSE(outcome.done);
  EXPECT_THAT(outcome.detector, Optional(1u));
  EXPECT_EQ(outcome.frame, 7u);
  EXPECT_EQ(outcome.phase, process::Phase::kUpdate);
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
  for (const char* what : {"allocate", "allocate away"}) {
    const WorkerOutcome outcome = outcome_of(what);
    expect_booked_on_detector_one(outcome);
    EXPECT_EQ(outcome.reason, "more than 300 MiB resident (memory limit)") << what;
  }
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
  EXPECT_THAT(outcome.last_detector, Optional(1u));
  EXPECT_EQ(outcome.frame, 3u);
  EXPECT_EQ(outcome.phase, process::Phase::kTruth);
}

TEST(Supervisor, DetectorThatIsNotInTheJobIsNoDetector) {
  const Scratch scratch;
  RunSettings settings = limits(20.0);
  settings.detectors = {"one", "two"};
  const WorkerOutcome outcome =
      run_supervised(CONTACTCHECK_FAKE_WORKER, scratch.write("job", "wild"), settings,
                     [](const WorkerProgress&) {});
  EXPECT_EQ(outcome.detector, std::nullopt);
  EXPECT_EQ(outcome.last_detector, std::nullopt);
}

TEST(Supervisor, WorkerThatDoesNotLeaveAfterItsAnswerIsDone) {
  EXPECT_TRUE(outcome_of("hang late", 0.25).done);
}

TEST(Supervisor, OutputOfTheWorkerIsNotTheProgramsOutput) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const bool done = outcome_of("talk").done;
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(done);
}

TEST(Supervisor, KeepsTheLastWordsOfAWorkerThatDied) {
  EXPECT_EQ(outcome_of("last words").error_text, "last words\n");
  EXPECT_EQ(outcome_of("talk").error_text, "") << "it has not died";
}

TEST(Supervisor, OutputBeyondItsLimitIsStoppedAndNamed) {
  const WorkerOutcome outcome = outcome_of("flood");
  expect_booked_on_detector_one(outcome);
  EXPECT_EQ(outcome.reason, "more than 64 MiB written to standard output and error (output limit)");
  EXPECT_EQ(outcome.error_text.size(), std::size_t{64} << 10) << "only its beginning is kept";
}

TEST(Supervisor, WorkerHasAnEmptyInput) { EXPECT_TRUE(outcome_of("read").done); }

struct Pids {
  int worker = 0, child = 0;
};

// Of a fake worker that has left a child; waits until it has written them down.
Pids pids_beside(const std::filesystem::path& job) {
  Pids pids;
  for (int i = 0; i < 1000 && pids.child == 0; ++i) {
    std::ifstream(job.string() + ".pids") >> pids.worker >> pids.child;
    if (pids.child == 0) usleep(10'000);
  }
  EXPECT_GT(pids.child, 0);
  return pids;
}

// Also one in a session of its own, whom no signal to the worker's group reaches.
TEST(Supervisor, ChildrenOfADeadWorkerAreEnded) {
  for (const char* what : {"crash with child", "crash with child away"}) {
    const Scratch scratch;
    const std::filesystem::path job = scratch.write("job", what);
    const WorkerOutcome outcome =
        run_supervised(CONTACTCHECK_FAKE_WORKER, job, limits(20.0), [](const WorkerProgress&) {});
    EXPECT_EQ(outcome.reason, "signal 11 (Segmentation fault)");
    EXPECT_TRUE(test::dies(pids_beside(job).child)) << what;
  }
}

// A process that supervises `job`, struck by `signal` in the middle. Its status at its end.
int status_of_struck_supervisor(const std::filesystem::path& job, int signal, Pids* pids) {
  const pid_t supervisor = fork();
  if (supervisor == 0) {
    ::signal(signal, SIG_DFL);  // ignored, SIGINT would be inherited by what a shell runs with &
    try {
      run_supervised(CONTACTCHECK_FAKE_WORKER, job, limits(20.0), [](const WorkerProgress&) {});
    } catch (const process::Interrupted& interrupted) {
      process::die_of(interrupted);
    }
    _exit(0);
  }
  *pids = pids_beside(job);
  kill(supervisor, signal);
  int status = 0;
  waitpid(supervisor, &status, 0);
  return status;
}

TEST(Supervisor, InterruptEndsWorkerItsChildrenAndTheSupervisorByThatSignal) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Scratch scratch;
    Pids pids;
    const int status =
        status_of_struck_supervisor(scratch.write("job", "hang with child"), signal, &pids);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    EXPECT_TRUE(test::dies(pids.worker));
    EXPECT_TRUE(test::dies(pids.child));
  }
}

TEST(Supervisor, WorkerDoesNotOutliveASupervisorThatIsKilled) {
  const Scratch scratch;
  Pids pids;
  status_of_struck_supervisor(scratch.write("job", "hang with child"), SIGKILL, &pids);
  EXPECT_TRUE(test::dies(pids.worker));
  kill(pids.child, SIGKILL);  // nobody is left who could
}

TEST(Supervisor, MissingProgramIsASentence) {
  const std::string sentence = test::sentence_of([] {
    run_supervised("/nonexistent/worker", "job", limits(1.0), [](const WorkerProgress&) {});
  });
  EXPECT_THAT(sentence, HasSubstr("/nonexistent/worker"));
  EXPECT_THAT(sentence, HasSubstr("No such file"));
}

TEST(Supervisor, ReportsProgressWhileTheWorkerRuns) {
  const Scratch scratch;
  bool half_in_frame_seven = false;
  run_supervised(CONTACTCHECK_FAKE_WORKER, scratch.write("job", "slowly"), limits(20.0),
                 [&](const WorkerProgress& p) {
                   if (p.share == 0.5 && p.detector == 1u && p.frame == 7u)
                     half_in_frame_seven = true;
                 });
  EXPECT_TRUE(half_in_frame_seven);
}

constexpr const char* kScene = R"({"id": "tiny", "frames": 3, "duration": 1, "levels": ["triangle"],
  "bodies": [{"name": "a", "mesh": {"shape": "box"}},
             {"name": "b", "mesh": {"shape": "box", "center": [0.9, 0.1, 0.1]}}]})";

Job job_in(const Scratch& scratch, const std::filesystem::path& scene) {
  Job job;
  job.scene = scene;
  job.settings.detectors = {"fcl-aabb"};
  job.settings.timing = false;
  job.answer_file = scratch.folder() / "answer";
  return job;
}

TEST(Supervisor, RealWorkerWritesItsAnswer) {
  const Scratch scratch;
  const Job job = job_in(scratch, scratch.write("tiny.json", kScene));
  write_job(scratch.folder() / "job", job);
  const WorkerOutcome outcome = run_supervised(CONTACTCHECK_PROGRAM, scratch.folder() / "job",
                                               RunSettings{}, [](const WorkerProgress&) {});
  ASSERT_TRUE(outcome.done) << outcome.reason;
  const SceneAnswer answer = read_answer(job.answer_file);
  EXPECT_EQ(answer.scene.id, "tiny");
  ASSERT_EQ(answer.detectors.size(), 1u);
  EXPECT_TRUE(answer.detectors[0].run.ok());
  EXPECT_EQ(answer.detectors[0].run.levels.at(Level::kTriangle).missed, 0u);
  EXPECT_GT(std::get<std::uint64_t>(answer.scene.truth.at(Level::kTriangle)), 0u);
}

TEST(Supervisor, RealWorkerWithoutItsSceneExitsWithTwoOutsideAnyDetector) {
  const Scratch scratch;
  write_job(scratch.folder() / "job", job_in(scratch, scratch.folder() / "missing.json"));
  const WorkerOutcome outcome = run_supervised(CONTACTCHECK_PROGRAM, scratch.folder() / "job",
                                               RunSettings{}, [](const WorkerProgress&) {});
  EXPECT_FALSE(outcome.done);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.detector, std::nullopt);
  EXPECT_EQ(outcome.phase, process::Phase::kScene);
}

}  // namespace
}  // namespace contactcheck::suite
