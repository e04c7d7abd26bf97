#include "tests/reference/plugin/plugin_run.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "reference/text/shell_word.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"

namespace contactcheck::test {

using nlohmann::json;

std::string misbehaving_library(const std::string& fault) {
  return std::string(CONTACTCHECK_MISBEHAVING_LIBRARY) + ":fault=" + fault;
}

std::string misbehaving_command(const std::string& fault) {
  return text::in_shell(CONTACTCHECK_PYTHON3) + " -B " +
         text::in_shell(CONTACTCHECK_MISBEHAVING_COMMAND) + " " + fault;
}

PluginRun::PluginRun(const std::vector<std::string>& words, const std::vector<std::string>& flags,
                     const std::filesystem::path& program) {
  const std::string scene = scratch_.write("tiny.json", tiny_scene()).string();
  std::vector<std::string> all = {"run", scene, "--out", out().string()};
  all.insert(all.end(), words.begin(), words.end());
  all.insert(all.end(), flags.begin(), flags.end());
  outcome_ = run_program(program, all);
}

std::filesystem::path PluginRun::own_program() { return CONTACTCHECK_PROGRAM; }

bool PluginRun::has_results() const { return std::filesystem::exists(out() / "results.json"); }

const json& PluginRun::results() {
  if (results_.is_null()) {
    EXPECT_TRUE(has_results()) << outcome_.err;
    results_ = json::parse(text_of(out() / "results.json"), nullptr, false);
  }
  return results_;
}

json PluginRun::row(const std::string& detector) {
  if (results().is_object())
    for (const json& row : results().at("runs"))
      if (row.at("detector") == detector) return row;
  ADD_FAILURE() << "no row of " << detector << ": " << outcome_.err;
  return {{"status", ""}, {"message", ""}};
}

std::string PluginRun::schema_errors() const {
  const Outcome valid = run_program(
      CONTACTCHECK_PYTHON3, {"-B", CONTACTCHECK_VALIDATOR, (out() / "results.json").string()});
  return valid.exit_code == 0 ? "" : valid.out + valid.err;
}

void expect_refusal(const PluginRun& run, const std::vector<std::string>& pieces) {
  const std::string& said = run.outcome().err;
  EXPECT_EQ(run.outcome().exit_code, 2) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_THAT(said, testing::StartsWith("contactcheck: "));
  for (const std::string& piece : pieces) EXPECT_THAT(said, testing::HasSubstr(piece));
  EXPECT_EQ(run.outcome().out, "");
  EXPECT_FALSE(std::filesystem::exists(run.out())) << "nothing may be written";
}

}  // namespace contactcheck::test
