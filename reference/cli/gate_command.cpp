#include "reference/gate/gate.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "core/types/suggestion.h"
#include "reference/cli/commands.h"
#include "reference/cli/github_job.h"
#include "reference/gate/output.h"
#include "reference/process/exit_codes.h"
#include "reference/results/results_file.h"
#include "reference/scene/catalogue.h"
#include "reference/text/file_text.h"
#include "reference/text/json_field.h"
#include "reference/text/lists.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

// A file, or the name of one that comes with contactcheck.
fs::path policy_file(const fs::path& policy) {
  std::error_code ignored;
  if (fs::exists(policy, ignored) || policy.has_extension() || policy.has_parent_path())
    return policy;
  const fs::path folder = scene::fixtures_directory() / "policies";
  std::vector<std::string> names;
  for (const fs::directory_entry& file : fs::directory_iterator(folder, ignored))
    if (file.path().extension() == ".json") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  if (std::find(names.begin(), names.end(), policy.string()) != names.end())
    return folder / (policy.string() + ".json");
  throw InputError("there is no policy " + text::in_quotes(policy.string()) + "; " +
                   suggestion(policy.string(), names) + "there are " + text::joined(names));
}

gate::GateResult judged(const GateArguments& arguments) {
  if (arguments.policy.empty() && arguments.baseline.empty())
    throw InputError("gate needs --policy FILE, --baseline FILE or both");
  gate::Policy policy =
      gate::read_policy(policy_file(arguments.policy.empty() ? "unchanged" : arguments.policy));
  policy.advisory_times = arguments.advisory_times;
  const results::Results now = results::results_in(arguments.results);
  if (arguments.baseline.empty()) return gate::run_gate(policy, now, nullptr);
  const results::Results before = results::results_in(arguments.baseline);
  return gate::run_gate(policy, now, &before);
}

// Files first: a gate that could not write one has said nothing yet.
void write_files(const GateArguments& arguments, const gate::GateResult& result) {
  if (!arguments.junit.empty()) write_file_atomically(arguments.junit, gate::junit_xml(result));
  const fs::path summary = arguments.github ? github_summary_file() : "";
  if (!summary.empty()) append_github_summary(summary, gate::github_summary(result));
}

}  // namespace

int gate_command(const GateArguments& arguments) {
  const gate::GateResult result = judged(arguments);
  write_files(arguments, result);
  std::fputs(gate::gate_screen(result, isatty(STDOUT_FILENO) != 0).c_str(), stdout);
  if (arguments.github) std::fputs(gate::github_annotations(result).c_str(), stdout);
  return result.red() ? process::kExitNo : 0;
}

}  // namespace contactcheck::cli
