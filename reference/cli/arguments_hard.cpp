#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"

namespace contactcheck::cli {
namespace {

struct TruthWords {
  std::vector<std::string> families;
  bool write = false;
};

struct DefectsWords {
  std::string results;
  bool write = false;
};

}  // namespace

void add_truth(CommandLine& line) {
  const auto words = std::make_shared<TruthWords>();
  CLI::App* truth = line.app.add_subcommand("truth", "Prints the ground truth of each hard case");
  truth->add_option("families", words->families, "ids of families (default: all)");
  truth->add_flag("--write", words->write, "update fixtures/hard/expected.json");
  truth->footer("Example:\n  contactcheck truth hard-vertex-face");
  choose(*truth, line, [words] { return truth_command(words->families, words->write); });
}

void add_defects(CommandLine& line) {
  const auto words = std::make_shared<DefectsWords>();
  CLI::App* defects =
      line.app.add_subcommand("defects", "Compares the wrong answers of a run with the known ones");
  defects->add_option("results", words->results, "results.json of the suite hard or scales")
      ->required();
  defects->add_flag("--write", words->write,
                    "update known-defects.json, readings.json and ranges.json of fixtures/hard");
  defects->footer(
      "Exit code 1 when a listed wrong answer did not show or has another count, or an unlisted "
      "one did.\n"
      "Of the suite scales the ranges in which each detector is right are compared.\n"
      "Example:\n  contactcheck run hard --no-timing\n  contactcheck defects out/results.json");
  choose(*defects, line, [words] { return defects_command(words->results, words->write); });
}

}  // namespace contactcheck::cli
