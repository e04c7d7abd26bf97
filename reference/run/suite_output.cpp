#include "reference/run/suite_output.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/deform/atomic_file.h"
#include "reference/defects/comparison.h"
#include "reference/results/results_json.h"
#include "reference/run/contacts_json.h"
#include "reference/run/goals.h"
#include "reference/run/out_folder.h"
#include "reference/run/shard_record.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using results::Results;

bool from_outside(const std::string& detector, const Results& results) {
  const std::string id = detector.substr(0, detector.find(':'));
  return std::any_of(results.plugins.begin(), results.plugins.end(),
                     [&](const results::Plugin& plugin) { return plugin.detector == id; });
}

// Where nothing could have shown a defect, there is nothing to say about them. An error of a
// detector from outside is its own matter, which its row tells.
void add_known_defects(const KnownDefects& known, Results& results, SuiteOutcome* outcome) {
  const DefectComparison comparison =
      compare_defects(known, sightings_of(results), versions_in(results));
  const std::vector<results::Scene>& scenes = results.scenes;
  const bool any_unjudged =
      std::any_of(scenes.begin(), scenes.end(), [](const auto& s) { return !s.unjudged.empty(); });
  const bool any_family =
      std::any_of(scenes.begin(), scenes.end(), [](const auto& s) { return s.family.has_value(); });
  const bool own_error =
      std::any_of(comparison.unlisted.begin(), comparison.unlisted.end(), [&](const Sighting& s) {
        return s.kind == SightingKind::kError && !from_outside(s.detector, results);
      });
  outcome->unlisted_error = any_unlisted_error(comparison) || any_unjudged;
  if (any_family || own_error) results.known_defects = in_results(known, comparison);
}

template <typename T>
void append(std::vector<T> from, std::vector<T>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

}  // namespace

SuiteOutput::SuiteOutput(fs::path out, fs::path scratch)
    : out_(std::move(out)), scratch_(std::move(scratch)) {}

void SuiteOutput::add(FinishedScene scene) {
  if (!scene.contacts.empty())
    write_file_atomically(scratch_ / contacts_path(scene.scene.id), scene.contacts);
  scenes_.push_back(std::move(scene.scene));
  append(std::move(scene.runs), runs_);
  append(std::move(scene.disagreements), disagreements_);
}

Results SuiteOutput::write(Results results, const std::vector<results::Goal>& goals,
                           const KnownDefects& known_defects, SuiteOutcome* outcome) {
  results.scenes = std::move(scenes_);
  results.runs = std::move(runs_);
  results.disagreements = std::move(disagreements_);
  outcome->oracle_wrong = 0;
  const std::vector<fs::path> cases = number_cases(results.disagreements);
  for (const results::Scene& scene : results.scenes)
    if (scene.pairs) outcome->oracle_wrong += scene.pairs->oracle_wrong;
  add_known_defects(known_defects, results, outcome);
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
  // All is on disk before anything of an earlier run goes: from here on there are only renames.
  write_file_atomically(scratch_ / "results.json", results::to_json(results).dump(1) + "\n");
  remove_old_cases(out_);
  move_cases(out_, cases);
  move_contacts(out_, scratch_, results.scenes);
  rename_file(scratch_ / "results.json", out_ / "results.json");
  return results;
}

}  // namespace contactcheck
