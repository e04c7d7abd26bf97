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
  CLI::App* gate = line.app.add_subcommand(
      "gate", "hold results against the rules of a policy; what a CI job calls");
  gate->add_option("results", arguments->results, "a results.json")->required();
  gate->add_option("--policy", arguments->policy,
                   "policy file (default with --baseline: fixtures/policies/unchanged.json)")
      ->type_name("FILE");
  gate->add_option("--baseline", arguments->baseline,
                   "results of an earlier run, as accept writes them; what they have must be there")
      ->type_name("RESULTS");
  gate->add_option("--junit", arguments->junit,
                   "JUnit XML: a test case per rule, scene and detector")
      ->type_name("FILE");
  gate->add_flag("--github", arguments->github,
                 "annotations for GitHub Actions, and a job summary in the file that "
                 "GITHUB_STEP_SUMMARY names");
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
      line.app.add_subcommand("accept", "make results the baseline that later gates compare with");
  accept->add_option("results", files->results, "a results.json")->required();
  accept->add_option("--as", files->baseline, "the baseline's file; what it changes is printed")
      ->required()
      ->type_name("FILE");
  accept->footer(
      "Example:\n  contactcheck accept out/results.json --as fixtures/baselines/ci.json");
  choose(*accept, line, [files] { return accept_command(files->results, files->baseline); });
}

}  // namespace contactcheck::cli
