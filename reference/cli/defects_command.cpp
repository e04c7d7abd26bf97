#include <algorithm>
#include <cstdio>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/cli/commands.h"
#include "reference/report/tables/known_defects.h"
#include "reference/report/tables/scale_ranges.h"
#include "reference/results/defect_comparison.h"
#include "reference/results/results_file.h"
#include "reference/results/scale_ranges.h"
#include "reference/scene/catalogue.h"

namespace contactcheck::cli {
namespace {

constexpr int kSurprised = 1;

// As listed they have library and version; of detectors from outside nobody knows any.
std::vector<results::ScaleRange> ranges_shown(const results::Results& results,
                                              const results::LibraryVersions& versions) {
  std::vector<results::ScaleRange> out = report::scale_ranges(results::Index(results));
  std::erase_if(out, [&](const auto& r) { return results.plugin_of(r.detector) != nullptr; });
  for (results::ScaleRange& range : out) {
    range.library = adapters::library_of(range.detector);
    const auto version = versions.find(range.library);
    if (version != versions.end()) range.version = version->second;
  }
  return out;
}

bool has_hard_cases(const results::Results& results) {
  return std::any_of(results.scenes.begin(), results.scenes.end(), [](const auto& scene) {
    return !scene.family || scene.family->range.empty();
  });
}

}  // namespace

std::filesystem::path hard_cases_folder() { return scene::fixtures_directory() / "hard"; }

int defects_command(const std::filesystem::path& file, bool write) {
  const results::Results results = results::results_in(file);
  const results::LibraryVersions versions = results::versions_in(results);
  results::SightingsOfRun run;
  std::vector<results::ScaleRange> shown;
  try {
    run = results::sightings_of(results);
    shown = ranges_shown(results, versions);
  } catch (const InputError& e) {
    throw InputError(file.string() + ": " + e.what());
  }
  results::KnownDefects known = results::read_known_defects(hard_cases_folder());
  if (write) {
    known = results::updated(known, run, versions, adapters::library_of);
    known.ranges = results::updated(std::move(known.ranges), shown);
    results::write_known_defects(hard_cases_folder(), known);
  }
  bool as_listed = true;
  if (shown.empty() || has_hard_cases(results)) {
    const results::DefectComparison comparison = results::compare_defects(known, run, versions);
    std::fputs(report::defects_text(results::in_results(known, comparison)).c_str(), stdout);
    as_listed = comparison.as_listed();
  }
  if (!shown.empty()) {
    const std::string changes =
        report::range_changes(results::ranges_of_run(known.ranges, results), shown);
    std::printf(
        "%zu ranges of sizes and distances, %s\n%s", shown.size(),
        changes.empty() ? "all as listed" : "not as listed (listed -> shown):", changes.c_str());
    as_listed &= changes.empty();
  }
  if (write)
    for (const char* name : {"known-defects.json", "readings.json", "ranges.json"})
      std::printf("%s\n", (hard_cases_folder() / name).c_str());
  return as_listed ? 0 : kSurprised;
}

}  // namespace contactcheck::cli
