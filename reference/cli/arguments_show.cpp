#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"

namespace contactcheck::cli {
namespace {

struct InitWords {
  std::string folder, language = "python";
};

struct ReportWords {
  std::string results, out = "out";
  std::vector<std::string> formats = all_report_formats();
};

}  // namespace

void add_list(CommandLine& line) {
  const auto arguments = std::make_shared<ListArguments>();
  CLI::App* list = line.app.add_subcommand("list", "Lists scenes, suites and detectors");
  list->add_flag("--suites", arguments->suites, "suites only");
  list->add_flag("--scenes", arguments->scenes, "scenes only");
  list->add_flag("--families", arguments->families,
                 "families of hard cases, and those over scales, only");
  list->add_flag("--detectors", arguments->detectors, "detectors only, with claims and options");
  list->add_option("--detector", arguments->named,
                   "this detector only, repeatable; FILE.so is a plug-in")
      ->type_name("NAME")
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

void add_init(CommandLine& line) {
  const auto words = std::make_shared<InitWords>();
  CLI::App* init = line.app.add_subcommand(
      "init", "Writes a folder with scene, detector, policy and CI job to begin with");
  init->add_option("folder", words->folder, "new folder")->required();
  init->add_option("--language", words->language, "python, c, c++ or javascript (default python)")
      ->type_name("NAME");
  init->footer("Example:\n  contactcheck init mine && cd mine");
  choose(*init, line, [words] { return init_command(words->folder, words->language); });
}

void add_report(CommandLine& line) {
  const auto words = std::make_shared<ReportWords>();
  CLI::App* report =
      line.app.add_subcommand("report", "Writes the reports of a results.json again");
  report
      ->add_option("results", words->results,
                   "results.json; recordings and contacts are read beside it")
      ->required();
  report->add_option("--format", words->formats, "csv, html, md (default: all)")
      ->type_name("LIST")
      ->delimiter(',');
  report->add_option("--out", words->out, "folder (default out)")->type_name("DIR");
  report->footer(
      "Examples:\n"
      "  contactcheck report out/results.json --out /tmp/report\n"
      "  contactcheck report out/results.json --format csv,md");
  choose(*report, line,
         [words] { return report_command(words->results, words->formats, words->out); });
}

}  // namespace contactcheck::cli
