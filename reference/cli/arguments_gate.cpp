#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"

namespace contactcheck::cli {
namespace {

struct AcceptFiles {
  std::string results, baseline;
};

}  // namespace

void add_gate(CommandLine& line) {
  const auto arguments = std::make_shared<GateArguments>();
  CLI::App* gate =
      line.app.add_subcommand("gate", "Checks results against the rules of a policy, in CI");
  gate->add_option("results", arguments->results, "results.json")->required();
  gate->add_option("--policy", arguments->policy,
                   "policy, a file or a name (default with --baseline: unchanged)")
      ->type_name("FILE");
  gate->add_option("--baseline", arguments->baseline,
                   "baseline, as accept writes it; its rows must be there")
      ->type_name("RESULTS");
  gate->add_option("--junit", arguments->junit,
                   "write JUnit XML: a test case per rule, scene and detector")
      ->type_name("FILE");
  gate->add_flag("--advisory-times", arguments->advisory_times,
                 "show rules on times, but let only the other rules decide");
  gate->add_flag("--github", arguments->github, "write GitHub annotations and a job summary");
  gate->footer(
      "Exit code 1 when the policy is broken.\n"
      "Examples:\n"
      "  contactcheck gate out/results.json --policy fixtures/policies/default.json\n"
      "  contactcheck gate out/results.json --policy fixtures/policies/ci.json \\\n"
      "      --baseline fixtures/baselines/ci.json --junit out/gate.xml --github\n"
      "  contactcheck gate out/results.json --baseline before.json");
  choose(*gate, line, [arguments] { return gate_command(*arguments); });
}

void add_accept(CommandLine& line) {
  const auto files = std::make_shared<AcceptFiles>();
  CLI::App* accept =
      line.app.add_subcommand("accept", "Writes results as the baseline of later gates");
  accept->add_option("results", files->results, "results.json")->required();
  accept->add_option("--as", files->baseline, "file of the baseline; changes are printed")
      ->required()
      ->type_name("FILE");
  accept->footer(
      "Example:\n  contactcheck accept out/results.json --as fixtures/baselines/ci.json");
  choose(*accept, line, [files] { return accept_command(files->results, files->baseline); });
}

}  // namespace contactcheck::cli
