// Whole runs of the program with one detector that strikes at its process: what happens to its own
// row, and that nothing happens to the others.
#include <gmock/gmock.h>
#include <signal.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "reference/scene/catalogue.h"
#include "tests/faults/whole_run.h"
#include "tests/reference/process/is_dead.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::WholeRun;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

constexpr int kDetectorFailed = 3;

const WholeRun& undisturbed() {
  static const WholeRun honest = test::run_whole(test::honest_detectors());
  return honest;
}

// What no fault may change in the row of another detector.
json essence(const json& row) {
  json out;
  for (const char* field : {"status", "message", "contact_hash", "levels", "per_frame", "geometry",
                            "stages", "float_environment", "notes"})
    out[field] = row.value(field, json());
  out["per_frame"].erase("frame_ms");
  return out;
}

void expect_undisturbed(const WholeRun& run, const std::string& detector) {
  EXPECT_EQ(essence(run.row(detector)), essence(undisturbed().row(detector))) << detector;
}

// The faulty detector goes first: whatever it leaves behind meets the others.
WholeRun run_with(const std::string& fault, std::vector<std::string> flags = {"--no-timing"}) {
  std::vector<std::string> detectors = {fault};
  for (const std::string& honest : test::honest_detectors()) detectors.push_back(honest);
  WholeRun result = test::run_whole(detectors, std::move(flags));
  for (const std::string& honest : test::honest_detectors()) expect_undisturbed(result, honest);
  return result;
}

void expect_error(const WholeRun& run, const std::string& fault, const std::string& message) {
  EXPECT_EQ(run.outcome.exit_code, kDetectorFailed) << run.outcome.err;
  EXPECT_EQ(run.row(fault).at("status"), "error");
  EXPECT_EQ(run.message(fault), message);
}

void expect_lethal(const std::string& fault, const std::string& message,
                   std::vector<std::string> flags = {"--no-timing"}) {
  expect_error(run_with(fault, std::move(flags)), fault, message);
}

WholeRun expect_harmless(const std::string& fault) {
  WholeRun result = run_with(fault);
  EXPECT_EQ(result.outcome.exit_code, 0) << result.outcome.err;
  EXPECT_EQ(result.row(fault).at("status"), "ok") << result.message(fault);
  EXPECT_EQ(result.row(fault).at("contact_hash"), undisturbed().row("fcl-aabb").at("contact_hash"))
      << "it answers with the truth";
  EXPECT_EQ(result.outcome.err, "scene 1 of 1: tiny\n");
  return result;
}

TEST(Isolation, AnErrorThatIsAKnownDefectIsNoFailureOfTheRun) {
  const test::Scratch scratch;
  fs::create_directories(scratch.folder() / "hard");
  fs::create_directory_symlink(scene::fixtures_directory() / "suites", scratch.folder() / "suites");
  scratch.write("hard/readings.json", R"({"readings": [
    {"where": "0", "kind": "error", "sentence": "ends",
     "seen": {"fault-abort": {"tiny": {"-": 1}}}}]})");
  const test::Environment own("CONTACTCHECK_FIXTURES", scratch.folder());
  EXPECT_EQ(test::run_whole({"fault-abort"}).outcome.exit_code, 0);
  EXPECT_EQ(test::run_whole({"fault-crash"}).outcome.exit_code, kDetectorFailed);
}

TEST(Isolation, HonestDetectorsAreUndisturbedByAnHonestOne) {
  const WholeRun result = expect_harmless("fault-none");
  EXPECT_THAT(result.notes("fault-none"), IsEmpty());
  EXPECT_THAT(result.row("fault-none").at("float_environment"), IsEmpty());
}

TEST(Isolation, CrashIsBookedOnFrameAndPhase) {
  expect_lethal("fault-crash", "scene tiny, frame 2, phase update: signal 11 (Segmentation fault)");
}

TEST(Isolation, CrashInPrepare) {
  expect_lethal("fault-crash:phase=prepare",
                "scene tiny, frame 0, phase prepare: signal 11 (Segmentation fault)");
}

TEST(Isolation, CrashInQueryOfTheLastFrame) {
  expect_lethal("fault-crash:frame=4,phase=query",
                "scene tiny, frame 4, phase query: signal 11 (Segmentation fault)");
}

TEST(Isolation, CrashWhileTimedLeavesTheOthersTheirTimes) {
  const std::string fault = "fault-crash:phase=timed";
  const WholeRun result = run_with(fault, {"--processes", "2"});
  EXPECT_EQ(result.schema_errors(), "");
  EXPECT_THAT(
      result.message(fault),
      MatchesRegex("scene tiny, frame 2, phase [a-z]+: signal 11 \\(Segmentation fault\\)"));
  EXPECT_EQ(result.outcome.exit_code, kDetectorFailed);
  for (const std::string& honest : test::honest_detectors())
    EXPECT_EQ(result.row(honest).at("time_ms").at("passes"), 2) << honest;
}

TEST(Isolation, HangInATimedUpdateIsBookedOnUpdate) {
  expect_lethal("fault-hang:phase=update-timed",
                "scene tiny, frame 2, phase update: no progress for 0.8 s (time limit of one call)",
                {"--processes", "2", "--call-limit", "0.8"});
}

TEST(Isolation, HangInATimedQueryIsBookedOnQuery) {
  expect_lethal("fault-hang:phase=timed",
                "scene tiny, frame 2, phase query: no progress for 0.8 s (time limit of one call)",
                {"--processes", "2", "--call-limit", "0.8"});
}

// Times between frames are given as frame 0; they are looked at up to frame 2, the first contact.
TEST(Isolation, CrashBetweenFramesIsBookedOnItsPhase) {
  expect_lethal("fault-crash:frame=0,phase=again",
                "scene tiny, frame 2, phase query: signal 11 (Segmentation fault)");
  expect_lethal("fault-crash:frame=0,phase=update-again",
                "scene tiny, frame 2, phase update: signal 11 (Segmentation fault)");
}

TEST(Isolation, ThrowWhileTimedIsAnErrorOfItsOwnRow) {
  const std::string fault = "fault-throw-int:phase=timed";
  const WholeRun result = run_with(fault, {"--processes", "2"});
  expect_error(result, fault,
               "scene tiny, frame 2, phase query: threw int, which is no std::exception (while "
               "timed)");
  EXPECT_EQ(result.row("fcl-aabb").at("time_ms").at("passes"), 2);
}

TEST(Isolation, AbortIsItsSignal) {
  expect_lethal("fault-abort", "scene tiny, frame 2, phase update: signal 6 (Aborted)");
}

TEST(Isolation, TerminateInAThreadIsAnAbortAndItsWordsAreShown) {
  const WholeRun result = run_with("fault-terminate-thread");
  expect_error(result, "fault-terminate-thread",
               "scene tiny, frame 2, phase update: signal 6 (Aborted)");
  EXPECT_THAT(result.outcome.err, AllOf(HasSubstr("scene tiny, detector fault-terminate-thread"),
                                        HasSubstr("  | "), HasSubstr("nobody catches this")));
}

TEST(Isolation, ExitInTheMiddleIsAnError) {
  // With leak checks on, exit turns 0 into the checker's own code.
  const WholeRun result = run_with("fault-exit");
  EXPECT_EQ(result.outcome.exit_code, kDetectorFailed);
  EXPECT_THAT(result.message("fault-exit"),
              StartsWith("scene tiny, frame 2, phase update: exit code "));
}

TEST(Isolation, ExitAtOnceIsAnError) {
  expect_lethal("fault-quick-exit", "scene tiny, frame 2, phase update: exit code 0");
}

TEST(Isolation, EndlessLoopMeetsTheLimitOfTheCommandLine) {
  expect_lethal("fault-hang",
                "scene tiny, frame 2, phase update: no progress for 0.8 s (time limit of one call)",
                {"--no-timing", "--call-limit", "0.8"});
}

TEST(Isolation, MemoryMeetsTheLimitOfTheCommandLine) {
  expect_lethal("fault-memory",
                "scene tiny, frame 2, phase update: more than 400 MiB resident (memory limit)",
                {"--no-timing", "--memory-limit", "400"});
}

TEST(Isolation, OutputMeetsItsLimit) {
  expect_lethal("fault-flood",
                "scene tiny, frame 2, phase update: more than 64 MiB written to standard output "
                "and error (output limit)");
}

TEST(Isolation, ThrownTextIsShownInPrintableForm) {
  expect_lethal("fault-throw", "scene tiny, frame 2, phase update: caf?is shut");
}

TEST(Isolation, ThrownIntIsNamed) {
  expect_lethal("fault-throw-int:phase=prepare",
                "scene tiny, frame 0, phase prepare: threw int, which is no std::exception");
}

TEST(Isolation, TwoFaultsAreTwoErrors) {
  const WholeRun result =
      test::run_whole({"fault-crash", "fcl-aabb", "fault-quick-exit:phase=query", "fault-throw"});
  EXPECT_EQ(result.outcome.exit_code, kDetectorFailed);
  EXPECT_THAT(result.message("fault-crash"), HasSubstr("signal 11"));
  EXPECT_THAT(result.message("fault-quick-exit:phase=query"), HasSubstr("exit code 0"));
  EXPECT_THAT(result.message("fault-throw"), HasSubstr("caf?"));
  EXPECT_EQ(result.schema_errors(), "");
  expect_undisturbed(result, "fcl-aabb");
}

TEST(Isolation, RoundingModeIsNotedAndRestored) {
  const WholeRun result = expect_harmless("fault-rounding");
  EXPECT_THAT(result.row("fault-rounding").at("float_environment"),
              ElementsAre("update changed rounding mode"));
}

#if defined(__SSE__)

TEST(Isolation, FlushToZeroIsNotedAndRestored) {
  const WholeRun result = expect_harmless("fault-flush");
  EXPECT_THAT(result.row("fault-flush").at("float_environment"),
              ElementsAre("update changed flush-to-zero, denormals-are-zero"));
}

TEST(Isolation, TrapsAreNotedAndRestored) {
  const WholeRun result = expect_harmless("fault-trap");
  EXPECT_THAT(result.row("fault-trap").at("float_environment"),
              ElementsAre("update changed traps"));
}

#endif

TEST(Isolation, OutputIsNotedAndReachesNobody) {
  const WholeRun result = expect_harmless("fault-stdout");
  EXPECT_THAT(result.notes("fault-stdout"),
              ElementsAre("wrote to standard output: \"[31mhello from a library\"",
                          "wrote to standard error: \"a warning\""));
  EXPECT_THAT(result.outcome.out, testing::Not(HasSubstr("hello")));
  EXPECT_EQ(result.schema_errors(), "");
}

TEST(Isolation, ClosedStreamsAreNotedAndOpenedAgain) {
  const std::string close = "fault-close", talk = "fault-stdout";
  const WholeRun result = test::run_whole({close, talk, "fcl-aabb"});
  EXPECT_EQ(result.outcome.exit_code, 0) << result.outcome.err;
  EXPECT_THAT(result.notes(close), ElementsAre("closed or replaced standard output",
                                               "closed or replaced standard error"));
  EXPECT_THAT(result.notes(talk), Contains("wrote to standard error: \"a warning\""));
  EXPECT_THAT(result.notes(talk), Contains(HasSubstr("hello from a library")));
  expect_undisturbed(result, "fcl-aabb");
}

TEST(Isolation, LocaleIsNotedAndRestored) {
  const WholeRun result = expect_harmless("fault-locale");
  EXPECT_THAT(result.notes("fault-locale"), ElementsAre("changed the locale"));
}

TEST(Isolation, WorkingDirectoryIsNotedAndRestored) {
  const WholeRun result = expect_harmless("fault-directory");
  EXPECT_THAT(result.notes("fault-directory"), ElementsAre("changed the working directory"));
}

TEST(Isolation, WhatChangesWhileItIsTimedAloneIsNotedOnceAsThat) {
  const std::string fault = "fault-directory:phase=timed";
  const WholeRun result = run_with(fault, {"--processes", "2"});
  EXPECT_EQ(result.row(fault).at("status"), "ok") << result.message(fault);
  EXPECT_THAT(result.notes(fault), ElementsAre("changed the working directory (while timed)"));
}

TEST(Isolation, WhatChangedWhileItWasJudgedIsNotNotedAgainWhileItIsTimed) {
  const WholeRun result = run_with("fault-directory", {"--processes", "2"});
  EXPECT_THAT(result.notes("fault-directory"), ElementsAre("changed the working directory"));
}

TEST(Isolation, SignalHandlersAndAlarmsAreTakenBack) {
  const WholeRun result = expect_harmless("fault-signals");
  const std::string numbers = std::to_string(SIGUSR1) + ", " + std::to_string(SIGALRM);
  EXPECT_THAT(result.notes("fault-signals"),
              ElementsAre("changed the handling of signals " + numbers, "left a timer running",
                          "changed which signals are blocked"));
}

TEST(Isolation, CrashAtExitComesAfterTheAnswer) { expect_harmless("fault-at-exit"); }

TEST(Isolation, ForkedCopyOfTheWorkerSpeaksForNobody) {
  expect_lethal("fault-fork", "scene tiny, frame 2, phase update: signal 11 (Segmentation fault)");
}

TEST(Isolation, ChildrenOfALibraryEndWithTheWorker) {
  const WholeRun result = expect_harmless("fault-children");
  ASSERT_EQ(result.notes("fault-children").size(), 1u);
  const std::string note = result.notes("fault-children").front();
  const std::size_t number = note.find("child ");
  ASSERT_NE(number, std::string::npos) << note;
  EXPECT_TRUE(test::dies(std::atoi(note.c_str() + number + 6)));
}

TEST(Isolation, ListOfTheFaultyProgramNamesTheFaults) {
  const Outcome list = test::run_program(CONTACTCHECK_WITH_FAULTS, {"list", "--detectors"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_THAT(list.out, HasSubstr("\nfault-hang\n"));
}

}  // namespace
}  // namespace contactcheck
