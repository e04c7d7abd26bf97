#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"

namespace contactcheck::cli {

void add_queries(CommandLine& line) {
  const auto arguments = std::make_shared<QueriesArguments>();
  CLI::App* queries = line.app.add_subcommand(
      "queries", "Judges tests of moving elements on query files, by exact truth");
  queries->add_option("files", arguments->files,
                      "CSV of rationals, eight lines a query (reference/queries/README.md)");
  queries->add_flag("--families", arguments->families, "hard families of this program, no files");
  queries
      ->add_option("--kind", arguments->kind,
                   "vertex-face or edge-edge, where name and folder do not say")
      ->check(CLI::IsMember({"vertex-face", "edge-edge"}))
      ->type_name("KIND");
  queries
      ->add_option("--truth", arguments->truths,
                   "the file's truth as a JSON list of booleans; once for each file")
      ->allow_extra_args(false)
      ->type_name("FILE");
  queries
      ->add_option("--detector", arguments->detectors,
                   "exact, root-finder, fcl-intersect or bullet-bernstein (default: all)")
      ->allow_extra_args(false)
      ->type_name("NAME");
  queries->add_option("--out", arguments->out, "folder of queries.json (default out)")
      ->type_name("DIR");
  queries->footer(
      "Early and late: of the time of contact, as fractions of the step. A detector in single\n"
      "precision is judged twice: on the doubles, and on what it was fed. \"ok\" in a row of a\n"
      "family: no error, and times right within 1e-6.\n"
      "Examples:\n"
      "  contactcheck queries vertex-face/data_0.csv\n"
      "  contactcheck queries --families\n"
      "  contactcheck queries 326vf.csv --truth 326vf_mma_bool.json --detector exact");
  choose(*queries, line, [arguments] { return queries_command(*arguments); });
}

}  // namespace contactcheck::cli
