#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"
#include "reference/cli/run_and_report.h"
#include "reference/process/exit_codes.h"
#include "reference/reproduce/paper_arithmetic.h"
#include "reference/reproduce/paper_report.h"
#include "reference/reproduce/paper_tables.h"
#include "reference/reproduce/reproduction.h"
#include "reference/reproduce/reproduction_report.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/suite_file.h"

namespace contactcheck::cli {
namespace {

using Json = nlohmann::ordered_json;

// The paper has nothing to say of other scenes, nor of these at full resolution.
void check_targets(const std::vector<std::string>& targets, const reproduce::PaperTables& tables) {
  std::string allowed = "paper";
  for (const reproduce::PaperScene& scene : tables.scenes)
    allowed += ", " + reproduce::scene_of_paper(scene.id);
  for (const std::string& target : targets) {
    const bool known =
        target == "paper" || std::any_of(tables.scenes.begin(), tables.scenes.end(),
                                         [&](const reproduce::PaperScene& s) {
                                           return target == reproduce::scene_of_paper(s.id);
                                         });
    if (!known)
      throw InputError("\"" + target + "\" is no scene of the paper; allowed: " + allowed);
  }
}

void print(const std::filesystem::path& out, const Json& reproduction, bool quiet) {
  if (!quiet) {
    const auto& findings = reproduction.at("paper").at("findings");
    const auto contradictions = std::count_if(
        findings.begin(), findings.end(), [](const Json& f) { return f.at("agrees") == false; });
    std::printf("%s\nThe paper's own numbers: %zu checks, %zu contradict a claim or cannot be.\n\n",
                reproduce::reproduction_terminal(reproduction).c_str(), findings.size(),
                static_cast<std::size_t>(contradictions));
  }
  std::printf("%s  %s  %s\n", (out / "reproduction.md").c_str(),
              (out / "reproduction.json").c_str(), (out / "report.md").c_str());
}

}  // namespace

int reproduce_command(RunArguments arguments, const DetectorCatalog& catalog) {
  const reproduce::PaperTables tables =
      reproduce::load_paper_tables(scene::fixtures_directory() / "paper" / "tables.json");
  // Single scenes are run with the suite's detectors too: the tables are made of these.
  if (arguments.detectors.empty())
    arguments.detectors =
        scene::load_suite(scene::find_target("paper", scene::fixtures_directory()).file).detectors;
  if (arguments.targets.empty()) arguments.targets = {"paper"};
  check_targets(arguments.targets, tables);
  arguments.closed_loop = true;
  suite::SuiteOutcome outcome;
  const ReportedRun reported = run_and_report(arguments, catalog, &outcome);
  const results::Results& results = reported.results;
  const std::vector<reproduce::PaperFinding> findings = reproduce::check_paper(tables);
  Json reproduction = reproduce::reproduce(results, tables);
  reproduction["paper"] = reproduce::paper_json(tables, findings);
  write_file_atomically(arguments.out / "reproduction.json", reproduction.dump(1) + "\n");
  write_file_atomically(
      arguments.out / "reproduction.md",
      reproduce::reproduction_markdown(reproduction) + reproduce::paper_markdown(tables, findings));
  // Once more, now that the page can have the paper's tables.
  write_report(arguments.out, report_texts(results, arguments.out, all_report_formats(),
                                           reproduce::paper_part(reproduction)));
  print(arguments.out, reproduction, arguments.quiet);
  return outcome.unlisted_error ? process::kExitUnlistedError : 0;
}

}  // namespace contactcheck::cli
