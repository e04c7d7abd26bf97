#include "reference/suite/suite_output.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/deform/atomic_file.h"
#include "reference/judge/contacts_json.h"
#include "reference/results/defect_comparison.h"
#include "reference/results/results_json.h"
#include "reference/results/scale_ranges.h"
#include "reference/suite/measured_goals.h"
#include "reference/suite/out_folder.h"
#include "reference/suite/shard_record.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;
using results::Results;

// The list is about the families beside it: of others, as a minimal case, the rows say it all. An
// error of a detector from outside is its own matter, which its row tells.
void add_known_defects(const results::KnownDefects& known, Results& results,
                       SuiteOutcome* outcome) {
  const results::DefectComparison comparison = results::compare_defects(
      known, results::sightings_of(results), results::versions_in(results));
  const std::vector<results::Scene>& scenes = results.scenes;
  const bool any_unjudged =
      std::any_of(scenes.begin(), scenes.end(), [](const auto& s) { return !s.unjudged.empty(); });
  const bool any_listed = std::any_of(scenes.begin(), scenes.end(), [&](const auto& s) {
    return s.family.has_value() && known.families.contains(s.id);
  });
  const bool own_error =
      std::any_of(comparison.unlisted.begin(), comparison.unlisted.end(), [&](const auto& entry) {
        const results::Sighting& s = entry.first;
        return s.kind == results::SightingKind::kError && results.plugin_of(s.detector) == nullptr;
      });
  outcome->unlisted_error = results::any_unlisted_error(comparison) || any_unjudged;
  if (any_listed || own_error) results.known_defects = results::in_results(known, comparison);
}

template <typename T>
void append(std::vector<T> from, std::vector<T>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

}  // namespace

SuiteOutput::SuiteOutput(fs::path out, fs::path scratch)
    : out_(std::move(out)), scratch_(std::move(scratch)) {}

void SuiteOutput::write_contacts(FinishedScene& scene) const {
  if (!scene.contacts.empty())
    write_file_atomically(scratch_ / judge::contacts_path(scene.scene.id), scene.contacts);
  scene.contacts.clear();
}

void SuiteOutput::add(FinishedScene scene) {
  write_contacts(scene);
  if (!scene.hash.empty()) identities_[scene.scene.id] = std::move(scene.hash);
  scenes_.push_back(std::move(scene.scene));
  append(std::move(scene.runs), runs_);
  append(std::move(scene.disagreements), disagreements_);
}

Results SuiteOutput::write(Results results, const std::vector<results::Goal>& goals,
                           const results::KnownDefects& known_defects, SuiteOutcome* outcome) {
  results.identities = std::move(identities_);
  results.scenes = std::move(scenes_);
  results.runs = std::move(runs_);
  results.disagreements = std::move(disagreements_);
  outcome->oracle_wrong = 0;
  const std::vector<fs::path> cases = number_cases(results.disagreements);
  for (const results::Scene& scene : results.scenes)
    if (scene.pairs) outcome->oracle_wrong += scene.pairs->oracle_wrong;
  add_known_defects(known_defects, results, outcome);
  results.known_ranges = results::ranges_of_run(known_defects.ranges, results);
  // A shard's goals would miss the scenes of the others.
  if (!results.shard) {
    results.goals = measure_goals(goals, results);
  } else {
    NamedFiles files;
    for (const results::Scene& scene : results.scenes)
      if (!scene.contacts.empty()) files[scene.contacts] = scratch_ / scene.contacts;
    for (const results::Run& run : results.runs)
      if (!run.recording.empty()) files[run.recording] = out_ / run.recording;
    for (std::size_t i = 0; i < cases.size(); ++i)
      files[results.disagreements[i].case_file] = cases[i];
    results.shard->files = file_hashes(files);
  }
  // All is on disk before anything of an earlier run goes: from here on there are only renames. Its
  // results.json goes first: with the cases of this run it would name others than its own.
  write_file_atomically(scratch_ / "results.json", results::to_json(results).dump(1) + "\n");
  std::error_code ignored;
  fs::remove(out_ / "results.json", ignored);
  remove_old_cases(out_);
  move_cases(out_, cases);
  move_contacts(out_, scratch_, results.scenes);
  rename_file(scratch_ / "results.json", out_ / "results.json");
  return results;
}

}  // namespace contactcheck::suite
