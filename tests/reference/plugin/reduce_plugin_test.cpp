// `contactcheck reduce` of the wrong answers of detectors from outside.
#include <gmock/gmock.h>

#include "reference/text/shell_word.h"
#include "tests/reference/plugin/plugin_run.h"
#include "tests/support/files.h"

namespace contactcheck::plugin {
namespace {

using test::contactcheck_program;
using test::Outcome;
using test::PluginRun;
using testing::HasSubstr;

// The first spurious contact of a run, as the run's case file has it.
std::string spurious_case(PluginRun& run) {
  for (const auto& d : run.results().at("disagreements"))
    if (d.at("kind") == "spurious" && d.at("level") == "triangle")
      return (run.out() / d.at("case").get<std::string>()).string();
  ADD_FAILURE() << "no spurious contact";
  return "";
}

void expect_minimal(const Outcome& outcome, const std::string& case_file) {
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string least = case_file.substr(0, case_file.rfind('.')) + ".min.json";
  EXPECT_THAT(outcome.err, HasSubstr(least));
  EXPECT_TRUE(std::filesystem::exists(least));
}

TEST(ReducePlugin, OfALibrary) {
  const std::string library = test::misbehaving_library("always-lies");
  PluginRun run({"--detector", library});
  const std::string file = spurious_case(run);
  // Its option is in the case's name.
  expect_minimal(
      contactcheck_program({"reduce", file, "--detector", CONTACTCHECK_MISBEHAVING_LIBRARY}), file);
}

TEST(ReducePlugin, OfACommand) {
  const std::string command = test::misbehaving_command("always-lies");
  PluginRun run({"--detector-cmd", command});
  const std::string file = spurious_case(run);
  expect_minimal(
      contactcheck_program({"reduce", file, "--detector-cmd", command, "--budget", "60"}), file);
}

TEST(ReducePlugin, ByTheCommandThatTheRunPrints) {
  for (const std::vector<std::string>& detector :
       {std::vector<std::string>{"--detector", test::misbehaving_library("always-lies")},
        {"--detector-cmd", test::misbehaving_command("always-lies")}}) {
    const PluginRun run(detector, {"--no-timing", "--detector", "fcl-aabb"});
    const std::string& out = run.outcome().out;
    const std::string mark = "\nnext: " + text::in_shell(CONTACTCHECK_PROGRAM) + " ";
    const std::size_t at = out.find(mark);
    ASSERT_NE(at, std::string::npos) << out;
    std::vector<std::string> words =
        text::shell_words(out.substr(at + mark.size(), out.find('\n', at + 1) - at - mark.size()));
    words.insert(words.end(), {"--budget", "60"});
    const Outcome outcome = contactcheck_program(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
}

TEST(ReducePlugin, WithinTheRun) {
  const PluginRun run({"--detector", test::misbehaving_library("always-lies")},
                      {"--no-timing", "--reduce"});
  EXPECT_THAT(run.outcome().out, HasSubstr("\nreduced: tiny, "));
  EXPECT_THAT(run.outcome().out, testing::Not(HasSubstr("not reduced")));
  EXPECT_THAT(run.outcome().out, testing::Not(HasSubstr("\nnext: ")));
}

TEST(ReducePlugin, OfACaseThatDoesNotSayHowToMakeItIsRefused) {
  PluginRun run({"--detector", test::misbehaving_library("always-lies")});
  const std::string file = spurious_case(run);
  const Outcome outcome = contactcheck_program({"reduce", file});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("is of the detector \"misbehaving\", which this program does "
                                     "not have; one from outside is brought along by --detector "
                                     "FILE.so or --detector-cmd CMD"));
}

}  // namespace
}  // namespace contactcheck::plugin
