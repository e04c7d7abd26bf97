// Two stand-ins for builds of the program: scripts that leave prepared results, so that no test
// depends on the time of day.
#include <gmock/gmock.h>

#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::Outcome;
using test::text_of;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kRounds = 7;

// Writes its name and words into `order`, counts its runs, and copies NAME-RUN.json to the folder
// behind --out.
constexpr const char* kScript = R"(#!/bin/sh
here=$(dirname "$0")
name=$(basename "$0")
echo "$name $*" >> "$here/order"
while [ $# -gt 0 ]; do
  [ "$1" = --out ] && out=$2
  shift
done
run=$(cat "$here/$name.count" 2> /dev/null || echo 0)
echo $((run + 1)) > "$here/$name.count"
mkdir -p "$out" && cp "$here/$name-$run.json" "$out/results.json" || exit 1
)";

using Change = std::function<void(std::size_t round, Json& results)>;

void scale_times(double factor, Json& results) {
  Json& run = results["runs"][0];
  for (const char* part : {"playback", "cold"})
    for (auto& [phase, ms] : run["time_ms"][part].items())
      if (!ms.is_null()) ms = 10.0 * factor * ms.get<double>();
}

// Noise of a few percent, other for both builds, and a drift that both share.
double noise(std::size_t round, bool head) {
  constexpr double kDrift[kRounds] = {1.0, 1.4, 0.9, 1.1, 2.0, 1.0, 1.3};
  constexpr double kBase[kRounds] = {1.00, 1.03, 0.98, 1.02, 0.99, 1.01, 0.97};
  constexpr double kHead[kRounds] = {1.01, 0.98, 1.02, 0.99, 1.03, 0.97, 1.00};
  return kDrift[round] * (head ? kHead : kBase)[round];
}

class AbCommand : public testing::Test {
 protected:
  std::string build(const std::string& name, const Change& change, const std::string& end = "") {
    for (std::size_t round = 0; round < kRounds; ++round) {
      Json results = Json::parse(text_of(CONTACTCHECK_EXAMPLE_RESULTS));
      change(round, results);
      scratch_.write(name + "-" + std::to_string(round) + ".json", results.dump());
    }
    fs::remove(scratch_.folder() / (name + ".count"));
    const fs::path script = scratch_.write(name, kScript + end);
    fs::permissions(script, fs::perms::owner_all);
    return script.string();
  }

  std::string noisy_base() {
    return build("base",
                 [](std::size_t r, Json& results) { scale_times(noise(r, false), results); });
  }
  std::string noisy_head(
      double factor, const Change& change = [](std::size_t, Json&) {}) {
    return build("head", [&](std::size_t r, Json& results) {
      scale_times(factor * noise(r, true), results);
      change(r, results);
    });
  }

  Outcome ab(const std::string& base, const std::string& head, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"ab", base, head, "--quiet", "--out", out_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return contactcheck_program(words);
  }

  test::Scratch scratch_;
  fs::path out_ = scratch_.folder() / "out";
};

TEST_F(AbCommand, NoiseAlonePasses) {
  const Outcome outcome = ab(noisy_base(), noisy_head(1.0));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("PASS: "));
  EXPECT_THAT(outcome.out, Not(HasSubstr("Slower")));
}

TEST_F(AbCommand, ThirtyPercentSlowerFailsAndNamesTheDetector) {
  const Outcome outcome = ab(noisy_base(), noisy_head(1.3));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Slower than 1.10x (1)\n  hello  ffd-aabb-sphere2  1.3"));
  EXPECT_THAT(outcome.out, HasSubstr("FAIL: "));
}

TEST_F(AbCommand, LimitAndFloorAreOptions) {
  EXPECT_EQ(ab(noisy_base(), noisy_head(1.3), {"--slower-than", "1.5"}).exit_code, 0);
  EXPECT_EQ(ab(noisy_base(), noisy_head(1.3), {"--floor-us", "1e6"}).exit_code, 0);
}

TEST_F(AbCommand, RunsInTurnsWithTheSameWords) {
  EXPECT_EQ(ab(noisy_base(), noisy_head(1.0), {"hello", "--detector", "ffd-lazy", "--frames", "4"})
                .exit_code,
            0);
  std::istringstream lines(text_of(scratch_.folder() / "order"));
  std::string order;
  for (std::string line; std::getline(lines, line);) {
    order += line.substr(0, 4) + " ";
    EXPECT_EQ(line.substr(4), " run --quiet --processes 1 --frames 4 --detector ffd-lazy --out " +
                                  (out_ / line.substr(0, 4)).string() + " hello");
  }
  EXPECT_EQ(order, "base head head base base head head base base head head base base head ");
}

TEST_F(AbCommand, ChangedContactsFailUnlessTheyMay) {
  const Change changed = [](std::size_t, Json& results) {
    results["runs"][0]["contact_hash"] = "0xdead";
  };
  const Outcome outcome = ab(noisy_base(), noisy_head(1.0, changed));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("Other answers, base -> head (1)\n"
                                     "  hello  ffd-aabb-sphere2  contact hash "));
  EXPECT_THAT(outcome.out, HasSubstr("-> 0xdead\n"));
  EXPECT_EQ(ab(noisy_base(), noisy_head(1.0, changed), {"--accuracy-may-change"}).exit_code, 0);
}

TEST_F(AbCommand, OneMissedContactFails) {
  const Outcome outcome = ab(noisy_base(), noisy_head(1.0, [](std::size_t, Json& results) {
                               results["runs"][0]["levels"]["body"]["missed"] = 1;
                             }));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("body missed 0 -> 1"));
}

TEST_F(AbCommand, DetectorThatOneSideLacksIsNamed) {
  const Outcome outcome = ab(
      noisy_base(), noisy_head(1.0, [](std::size_t, Json& results) { results["runs"].erase(3); }));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("Only in base (1)\n  detector "));
}

TEST_F(AbCommand, ProgramThatFailsIsOneSentenceWithItsLastWords) {
  const std::string base = noisy_base();
  const Outcome outcome =
      ab(base, build(
                   "head", [](std::size_t, Json&) {}, "echo 'no such scene' >&2; exit 2\n"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "contactcheck: head \"" + (scratch_.folder() / "head").string() +
                             "\" ended in exit code 2: no such scene\n");
}

TEST_F(AbCommand, ErrorsInRowsAreNoFailureOfTheProgram) {
  const auto same = [](std::size_t, Json& results) { scale_times(1.0, results); };
  EXPECT_EQ(ab(build("base", same, "exit 3\n"), build("head", same, "exit 3\n")).exit_code, 0);
}

TEST_F(AbCommand, ProgramThatLeavesNoResultsIsRefused) {
  const std::string base = noisy_base();
  const std::string head = build(
      "head", [](std::size_t, Json&) {}, "rm \"$out/results.json\"\n");
  const Outcome outcome = ab(base, head);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr((out_ / "head" / "results.json").string()));
}

TEST_F(AbCommand, WhatIsNoProgramIsRefusedBeforeAnythingRuns) {
  const std::string base = noisy_base(), text = scratch_.write("text", "words").string();
  for (const std::string& other : {text, scratch_.folder().string(), std::string("/nonexistent")}) {
    const Outcome outcome = ab(base, other);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "contactcheck: head \"" + other + "\" is not a program that can be run\n");
  }
  EXPECT_FALSE(fs::exists(scratch_.folder() / "order"));
}

TEST_F(AbCommand, BadNumbersAreRefused) {
  const std::string base = noisy_base();
  for (const std::vector<std::string>& bad :
       std::vector<std::vector<std::string>>{{"--rounds", "4"},
                                             {"--slower-than", "0.9"},
                                             {"--slower-than", "nan"},
                                             {"--floor-us", "-1"},
                                             {"--floor-us", "nan"}}) {
    const Outcome outcome = ab(base, base, bad);
    EXPECT_EQ(outcome.exit_code, 2) << bad[0] << " " << bad[1];
    EXPECT_THAT(outcome.err, HasSubstr(bad[0]));
  }
}

// A round is one pass of each build; more of them are more rounds.
TEST_F(AbCommand, RepeatIsNoOption) {
  const Outcome outcome = ab("old", "new", {"--repeat", "3"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--repeat"));
}

TEST_F(AbCommand, GithubGetsAnnotationsAndASummaryBehindWhatIsThere) {
  const fs::path summary = scratch_.write("summary.md", "# Before\n");
  const test::Environment environment("GITHUB_STEP_SUMMARY", summary.string());
  const Outcome outcome = ab(noisy_base(), noisy_head(1.3), {"--github"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("\n::error title=contactcheck ab::slower than 1.10x: hello  "
                                     "ffd-aabb-sphere2  1.3"));
  EXPECT_THAT(text_of(summary), testing::StartsWith("# Before\n## contactcheck ab\n\nFAIL: "));
  EXPECT_THAT(text_of(summary), HasSubstr("| **slower** |\n"));
}

TEST_F(AbCommand, GithubWithoutItsFileIsRefusedBeforeAnythingRuns) {
  unsetenv("GITHUB_STEP_SUMMARY");
  const Outcome outcome = ab(noisy_base(), noisy_head(1.0), {"--github"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("GITHUB_STEP_SUMMARY"));
  EXPECT_FALSE(fs::exists(scratch_.folder() / "order"));
}

}  // namespace
}  // namespace contactcheck::cli
