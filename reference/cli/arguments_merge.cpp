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
  CLI::App* merge =
      line.app.add_subcommand("merge", "Assembles the results of all shards of a run");
  merge->add_option("results", arguments->results, "results.json of every shard")->required();
  merge->add_option("--out", arguments->out, "folder for all files (default out)")
      ->type_name("DIR");
  merge->footer(
      "The results equal those of one run, except timings. Missing, duplicate and damaged shards\n"
      "are refused, and shards of other versions, builds, settings or scenes.\n"
      "Timed shards must be of one kind of machine.\n"
      "Example:\n"
      "  contactcheck run references --shard 1/2 --out part1\n"
      "  contactcheck run references --shard 2/2 --out part2\n"
      "  contactcheck merge part1/results.json part2/results.json --out out");
  choose(*merge, line, [arguments] { return merge_command(arguments->results, arguments->out); });
}

}  // namespace contactcheck::cli
