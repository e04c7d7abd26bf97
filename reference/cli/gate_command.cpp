#include "reference/gate/gate.h"

#include <unistd.h>

#include <cstdio>
#include <optional>

#include "core/deform/atomic_file.h"
#include "reference/cli/commands.h"
#include "reference/cli/github_job.h"
#include "reference/gate/github.h"
#include "reference/gate/junit.h"
#include "reference/gate/screen.h"
#include "reference/results/results_file.h"
#include "reference/run/exit_codes.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

ResultsFile whole_results(const fs::path& file) {
  ResultsFile results(file);
  results.require_schema();
  return results;
}

GateResult judged(const GateArguments& arguments) {
  const Policy policy = read_policy(arguments.policy);
  const ResultsFile results = whole_results(arguments.results);
  std::optional<ResultsFile> baseline;
  if (!arguments.baseline.empty()) baseline = whole_results(arguments.baseline);
  const auto alone = [&](const Json& now) { return run_gate(policy, now, nullptr); };
  const auto beside = [&](const Json& now) {
    return baseline->read([&](const Json& before) { return run_gate(policy, now, &before); });
  };
  // What is wrong with the results is said of the results: first without the baseline.
  const GateResult result = results.read(alone);
  return baseline ? results.read(beside) : result;
}

// Files first: a gate that could not write one has said nothing yet.
void write_files(const GateArguments& arguments, const GateResult& result) {
  if (!arguments.junit.empty()) write_file_atomically(arguments.junit, junit_xml(result));
  const fs::path summary = arguments.github ? github_summary_file() : "";
  if (!summary.empty()) append_github_summary(summary, github_summary(result));
}

}  // namespace

int gate_command(const GateArguments& arguments) {
  const GateResult result = judged(arguments);
  write_files(arguments, result);
  std::fputs(gate_screen(result, isatty(STDOUT_FILENO) != 0).c_str(), stdout);
  if (arguments.github) std::fputs(github_annotations(result).c_str(), stdout);
  return result.red() ? kExitNo : 0;
}

}  // namespace contactcheck
