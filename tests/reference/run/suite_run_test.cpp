// The suite with workers that die outside detectors (fake_worker.cpp).
#include "reference/run/suite_run.h"

#include <gmock/gmock.h>

#include "core/types/check.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck {
namespace {

using test::Scratch;
using testing::AllOf;
using testing::HasSubstr;

SuiteRequest request_for(const Scratch& scratch, const std::string& scene) {
  SuiteRequest request;
  request.tasks = {{"fake", scratch.write(scene + ".json", "{}"), {"one", "two", "three"}, {}}};
  request.settings.timing = false;
  request.out = scratch.folder() / "out";
  request.executable = CONTACTCHECK_FAKE_WORKER;
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
  SuiteRequest request = request_for(scratch, "later");
  request.tasks.front().detectors.pop_back();
  request.settings.timing = true;
  request.settings.processes = 2;
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
}  // namespace contactcheck
