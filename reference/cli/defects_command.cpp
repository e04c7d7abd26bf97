#include <cstdio>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/cli/commands.h"
#include "reference/report/known_defects.h"
#include "reference/results/defect_comparison.h"
#include "reference/results/results_file.h"
#include "reference/scene/catalogue.h"

namespace contactcheck::cli {
namespace {

constexpr int kSurprised = 1;

}  // namespace

std::filesystem::path hard_cases_folder() { return scene::fixtures_directory() / "hard"; }

int defects_command(const std::filesystem::path& file, bool write) {
  const results::Results results = results::results_in(file);
  results::SightingsOfRun run;
  try {
    run = results::sightings_of(results);
  } catch (const InputError& e) {
    throw InputError(file.string() + ": " + e.what());
  }
  const results::LibraryVersions versions = results::versions_in(results);
  results::KnownDefects known = results::read_known_defects(hard_cases_folder());
  if (write) {
    known = results::updated(known, run, versions, adapters::library_of);
    results::write_known_defects(hard_cases_folder(), known);
  }
  const results::DefectComparison comparison = results::compare_defects(known, run, versions);
  std::fputs(report::defects_text(results::in_results(known, comparison)).c_str(), stdout);
  if (write)
    for (const char* name : {"known-defects.json", "readings.json"})
      std::printf("%s\n", (hard_cases_folder() / name).c_str());
  return comparison.as_listed() ? 0 : kSurprised;
}

}  // namespace contactcheck::cli
