#include <cstdio>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/cli/commands.h"
#include "reference/defects/comparison.h"
#include "reference/report/known_defects.h"
#include "reference/results/results_file.h"
#include "reference/scene/catalogue.h"

namespace contactcheck {
namespace {

constexpr int kSurprised = 1;

}  // namespace

std::filesystem::path known_defects_file() {
  return fixtures_directory() / "hard" / "known-defects.json";
}

int defects_command(const std::filesystem::path& file, bool write) {
  const results::Results results = results_in(file);
  SightingsOfRun run;
  try {
    run = sightings_of(results);
  } catch (const InputError& e) {
    throw InputError(file.string() + ": " + e.what());
  }
  const LibraryVersions versions = versions_in(results);
  KnownDefects known = read_known_defects(known_defects_file());
  if (write) {
    known = updated(known, run, versions, library_of);
    write_known_defects(known_defects_file(), known);
  }
  const DefectComparison comparison = compare_defects(known, run, versions);
  std::fputs(defects_text(in_results(known, comparison)).c_str(), stdout);
  if (write) std::printf("%s\n", known_defects_file().c_str());
  return comparison.not_shown.empty() && comparison.unlisted.empty() ? 0 : kSurprised;
}

}  // namespace contactcheck
