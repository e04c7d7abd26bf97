#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"

namespace contactcheck::cli {

void add_merge(CommandLine& line) {
  struct Arguments {
    std::vector<std::string> results;
    std::string out = "out";
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* merge = line.app.add_subcommand(
      "merge", "put the results of all shards of a run together (run --shard K/N)");
  merge->add_option("results", arguments->results, "the results.json of every shard")->required();
  merge->add_option("--out", arguments->out,
                    "folder for results.json, reports, cases, contacts, recordings (default out)");
  merge->footer(
      "The results are those of the run in one piece, times aside. Shards of other versions,\n"
      "builds, settings or scenes are refused, and so are a missing, a doubled and a damaged one.\n"
      "Timed shards must be of one kind of machine.\n"
      "Example:\n"
      "  contactcheck run references --shard 1/2 --out part1\n"
      "  contactcheck run references --shard 2/2 --out part2\n"
      "  contactcheck merge part1/results.json part2/results.json --out out");
  choose(*merge, line, [arguments] { return merge_command(arguments->results, arguments->out); });
}

}  // namespace contactcheck::cli
