#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"

namespace contactcheck::cli {
namespace {

struct ReportWords {
  std::string results, out = "out";
  std::vector<std::string> formats = all_report_formats();
};

}  // namespace

void add_list(CommandLine& line) {
  const auto arguments = std::make_shared<ListArguments>();
  CLI::App* list =
      line.app.add_subcommand("list", "scenes, suites and detectors, with one line each");
  list->add_flag("--suites", arguments->suites, "suites only");
  list->add_flag("--scenes", arguments->scenes, "scenes only");
  list->add_flag("--families", arguments->families, "families of hard cases only");
  list->add_flag("--detectors", arguments->detectors,
                 "detectors only, with what each claims and its options");
  list->add_option("--detector", arguments->named,
                   "this detector only, repeatable: a name, or with '/' or .so in it a shared "
                   "library of your own, which is loaded in a process of its own and asked")
      ->allow_extra_args(false);
  add_commands(*list, arguments->commands);
  list->footer(
      "Examples:\n"
      "  contactcheck list\n"
      "  contactcheck list --detectors\n"
      "  contactcheck list --detector ./libmine.so\n"
      "  contactcheck list --detector-cmd \"python3 mine.py\"");
  choose(*list, line, [arguments, &line] { return list_command(*arguments, line.catalog); });
}

void add_report(CommandLine& line) {
  const auto words = std::make_shared<ReportWords>();
  CLI::App* report =
      line.app.add_subcommand("report", "write the report of an old results.json again");
  report
      ->add_option("results", words->results,
                   "a results.json; the HTML report's 3D view draws the recordings and contacts "
                   "beside it")
      ->required();
  report->add_option("--format", words->formats, "formats: csv, html, md (default: all)")
      ->delimiter(',');
  report->add_option("--out", words->out, "folder (default out)");
  report->footer(
      "Examples:\n"
      "  contactcheck report out/results.json --out /tmp/report\n"
      "  contactcheck report out/results.json --format csv,md");
  choose(*report, line,
         [words] { return report_command(words->results, words->formats, words->out); });
}

}  // namespace contactcheck::cli
