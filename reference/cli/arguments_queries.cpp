#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/text/lists.h"

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
      ->add_option(
          "--detector", arguments->detectors,
          text::joined(line.catalog.impact_detectors(), [](const auto& d) { return d.id; }) +
              " or FILE.so, a plug-in (default: all of this program)")
      ->allow_extra_args(false)
      ->type_name("NAME");
  add_commands(*queries, arguments->commands);
  queries
      ->add_option("--cap", arguments->cap.absolute,
                   "farther apart than this no report is near (default: as it tolerates)")
      ->check(number_in(0, 1e300, "0 to 1e300"))
      ->type_name("METRES");
  queries
      ->add_option("--cap-of-start", arguments->cap.of_start,
                   "the same, as a share of the distance at the start")
      ->check(number_in(0, 1e300, "0 to 1e300"))
      ->type_name("SHARE");
  add_limits(*queries, arguments->call_limit, arguments->memory_limit_mib);
  queries->add_option("--out", arguments->out, "folder of queries.json (default out)")
      ->type_name("DIR");
  queries->footer(
      "Early and late: of the time of contact, as fractions of the step. Near: no contact, but\n"
      "within the detector's own tolerance. A detector in single precision is judged twice: on\n"
      "the doubles, and on what it was given. \"ok\" in a row of a family: no error, and times "
      "right\n"
      "within 1e-6.\n"
      "Examples:\n"
      "  contactcheck queries vertex-face/data_0.csv\n"
      "  contactcheck queries --families\n"
      "  contactcheck queries 326vf.csv --truth 326vf_mma_bool.json --detector exact\n"
      "  contactcheck queries vf.csv --detector ./libmine.so:tolerance=1e-6");
  choose(*queries, line, [arguments, &line] { return queries_command(*arguments, line.catalog); });
}

}  // namespace contactcheck::cli
