// Runs of the program with a detector from outside, on a small scene.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

/// The library of misbehaving_plugin.c with its option `fault`.
std::string misbehaving_library(const std::string& fault);
/// The command of misbehaving_command.py with its argument.
std::string misbehaving_command(const std::string& fault);

/// One run on the tiny scene (5 frames), without times unless `flags` say otherwise.
class PluginRun {
 public:
  explicit PluginRun(const std::vector<std::string>& words,
                     const std::vector<std::string>& flags = {"--no-timing"},
                     const std::filesystem::path& program = own_program());

  /// The contactcheck of this build.
  static std::filesystem::path own_program();

  const Outcome& outcome() const { return outcome_; }
  bool has_results() const;
  const nlohmann::json& results();
  /// The row of a detector. Fails the test where there is none.
  nlohmann::json row(const std::string& detector);
  std::filesystem::path out() const { return scratch_.folder() / "out"; }
  /// What the validator of results.json says; "" when all is well.
  std::string schema_errors() const;

 private:
  Scratch scratch_;
  Outcome outcome_;
  nlohmann::json results_;
};

/// Exit code 2, one sentence that has all of these, and nothing written.
void expect_refusal(const PluginRun& run, const std::vector<std::string>& pieces);

}  // namespace contactcheck::test
