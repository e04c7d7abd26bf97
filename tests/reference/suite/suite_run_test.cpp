// The suite with workers that die outside detectors (fake_worker.cpp).
#include "reference/suite/suite_run.h"

#include <gmock/gmock.h>

#include "core/types/check.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::suite {
namespace {

using test::Scratch;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

SuiteRequest request_for(const Scratch& scratch, const std::string& scene) {
  SuiteRequest request;
  request.tasks = {{"fake", scratch.write(scene + ".json", "{}"), {"one", "two", "three"}, {}}};
  request.settings.timing = false;
  request.out = scratch.folder() / "out";
  request.executable = CONTACTCHECK_FAKE_WORKER;
  return request;
}

// Of the detectors "one" and "two".
SuiteRequest timed_request(const Scratch& scratch, const std::string& scene,
                           std::size_t processes) {
  SuiteRequest request = request_for(scratch, scene);
  request.tasks.front().detectors.pop_back();
  request.settings.timing = true;
  request.settings.processes = processes;
  return request;
}

results::Results run(const SuiteRequest& request, SuiteOutcome* outcome) {
  return run_suite(request, {}, outcome);
}

TEST(SuiteRun, DeathInOwnCodeIsBookedOnTheDetectorThatRanLast) {
  const Scratch scratch;
  SuiteRequest request = request_for(scratch, "outside");
  request.tasks.front().detectors.pop_back();
  SuiteOutcome outcome;
  const auto results = run(request, &outcome);
  EXPECT_TRUE(outcome.unlisted_error);
  ASSERT_EQ(results.runs.size(), 2u);
  EXPECT_EQ(results.runs[0].status, results::Status::kRefused) << "the fake's answer";
  const results::Run& broken = results.runs[1];
  EXPECT_EQ(broken.detector, "two");
  EXPECT_EQ(broken.status, results::Status::kError);
  EXPECT_EQ(broken.message,
            "scene fake, frame 3, phase truth: signal 11 (Segmentation fault) in the suite's own "
            "code, after this detector had run");
  EXPECT_EQ(broken.frames, 9u);
}

TEST(SuiteRun, DetectorThatDiesInALaterProcessHasNoContacts) {
  const Scratch scratch;
  const SuiteRequest request = timed_request(scratch, "later", 2);
  SuiteOutcome outcome;
  const auto results = run(request, &outcome);
  ASSERT_EQ(results.runs.size(), 2u);
  EXPECT_TRUE(results.runs[0].ok());
  EXPECT_EQ(results.runs[1].status, results::Status::kError);
  EXPECT_EQ(results.scenes.at(0).contacts, "contacts/fake.json");
  EXPECT_EQ(test::text_of(request.out / "contacts" / "fake.json"),
            R"({"schema":"contactcheck-contacts/1","scene":"fake","limit":500,)"
            R"("truth":[{"frame":3,"count":1,"pairs":[0,2,1,5]}],)"
            R"("detectors":[{"detector":"one","level":"triangle","frames":[{"frame":3,)"
            R"("missed":{"count":1,"pairs":[0,2,1,5]},"spurious":{"count":0,"pairs":[]}}]}]})"
            "\n");
}

// Detector "two" is from outside: each of its turns has a process of its own.
TEST(SuiteRun, ProcessThatTimesIsGivenTheAnswersOfItsOwnTurnsAlone) {
  const Scratch scratch;
  SuiteRequest request = timed_request(scratch, "answers", 2);
  request.settings.plugin_ids = {"two"};
  SuiteOutcome outcome;
  const auto results = run(request, &outcome);
  ASSERT_EQ(results.runs.size(), 2u);
  for (const results::Run& row : results.runs) {
    EXPECT_TRUE(row.ok()) << row.message;
    EXPECT_EQ(row.times.size(), 1u) << row.detector;
  }
}

// Of each row, and of its speed-up over the first; of three that were asked for.
std::vector<std::pair<std::size_t, std::size_t>> passes_with(double one_pass_beyond) {
  const Scratch scratch;
  SuiteRequest request = timed_request(scratch, "well", 3);
  request.tasks.front().detectors.front() = "fcl-aabb";
  request.settings.one_pass_beyond = one_pass_beyond;
  SuiteOutcome outcome;
  std::vector<std::pair<std::size_t, std::size_t>> out;
  const auto results = run(request, &outcome);
  for (const results::Run& row : results.runs)
    out.emplace_back(row.times.at(0).passes,
                     row.speedup.at(Question::kTriangles).at("fcl-aabb").passes);
  return out;
}

// The fake's first detector takes 18 ms for a pass, the second 27 ns.
TEST(SuiteRun, DetectorWhosePassTakesLongerThanTheLimitHasOne) {
  EXPECT_THAT(passes_with(1e-9), ElementsAre(Pair(1, 1), Pair(1, 1)));
  EXPECT_THAT(passes_with(1e-3), ElementsAre(Pair(1, 1), Pair(3, 1)));
  EXPECT_THAT(passes_with(1.0), ElementsAre(Pair(3, 3), Pair(3, 3)));
  EXPECT_THAT(passes_with(0.0), ElementsAre(Pair(3, 3), Pair(3, 3))) << "no limit";
}

// Both have their turns in the same process, which is repeated without the one that died.
TEST(SuiteRun, DetectorThatDiesInItsSecondPassHasNoTimesAndTheOthersKeepTheirs) {
  const Scratch scratch;
  const SuiteRequest request = timed_request(scratch, "second-pass", 3);
  SuiteOutcome outcome;
  const auto results = run(request, &outcome);
  EXPECT_TRUE(outcome.unlisted_error);
  ASSERT_EQ(results.runs.size(), 2u);
  ASSERT_TRUE(results.runs[0].ok());
  EXPECT_EQ(results.runs[0].times.at(0).passes, 3u);
  const results::Run& broken = results.runs[1];
  EXPECT_EQ(broken.status, results::Status::kError);
  EXPECT_EQ(broken.message, "scene fake, frame 7, phase update: signal 6 (Aborted) (while timed)");
  EXPECT_EQ(broken.failed_frame, 7u);
  EXPECT_TRUE(broken.times.empty());
  EXPECT_TRUE(broken.speedup.empty());
}

TEST(SuiteRun, DeathThatGoesOnWithoutItsDetectorEndsTheRunWithASentence) {
  const Scratch scratch;
  SuiteOutcome outcome;
  try {
    run(request_for(scratch, "always"), &outcome);
    FAIL() << "it must end";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("\"fake\""), HasSubstr("signal 11"), HasSubstr("truth"),
                                HasSubstr("outside any detector")));
  }
}

TEST(SuiteRun, WhatTheOracleCannotJudgeCostsItsSceneNotTheRun) {
  const Scratch scratch;
  SuiteOutcome outcome;
  SuiteRequest request = request_for(scratch, "oracle");
  request.settings.memory_limit = std::uint64_t{300} << 20;
  const auto results = run(request, &outcome);
  EXPECT_TRUE(outcome.unlisted_error);
  ASSERT_EQ(results.runs.size(), 3u);
  for (const results::Run& row : results.runs) {
    EXPECT_EQ(row.status, results::Status::kError);
    EXPECT_EQ(row.failed_frame, 3u);
    EXPECT_EQ(row.message,
              "scene fake, frame 3, phase truth: more than 300 MiB resident (memory limit), before "
              "any detector: the oracle cannot judge this scene");
  }
}

TEST(SuiteRun, DeathOfTheOracleByItselfIsAnErrorOfTheSuite) {
  const Scratch scratch;
  SuiteOutcome outcome;
  EXPECT_THAT([&] { run(request_for(scratch, "judge"), &outcome); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("outside any detector")));
}

TEST(SuiteRun, BadInputIsOneSentenceWithTheWorkersOwnWords) {
  const Scratch scratch;
  SuiteOutcome outcome;
  testing::internal::CaptureStderr();
  const std::string sentence =
      test::sentence_of([&] { run(request_for(scratch, "refuse"), &outcome); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(sentence, AllOf(HasSubstr("\"fake\""), HasSubstr("exit code 2"),
                              HasSubstr("the scene is bad")));
}

}  // namespace
}  // namespace contactcheck::suite
