#include "reference/run/suite_output.h"

#include <algorithm>
#include <utility>

#include "core/deform/atomic_file.h"
#include "reference/defects/comparison.h"
#include "reference/run/contacts_json.h"
#include "reference/run/goals.h"
#include "reference/run/out_folder.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

bool from_outside(const std::string& detector, const Json& results) {
  const std::string id = detector.substr(0, detector.find(':'));
  const Json plugins = results.value("plugins", Json::array());
  return std::any_of(plugins.begin(), plugins.end(),
                     [&](const Json& plugin) { return plugin.at("detector") == id; });
}

// Of a detector from outside it is its own matter, which its row tells.
bool says_of_the_list(const DefectComparison& comparison, const Json& results) {
  return std::any_of(comparison.unlisted.begin(), comparison.unlisted.end(),
                     [&](const Sighting& s) {
                       return s.kind == SightingKind::kError && !from_outside(s.detector, results);
                     });
}

bool any_unjudged(const Json& results) {
  const Json& scenes = results.at("scenes");
  return std::any_of(scenes.begin(), scenes.end(),
                     [](const Json& scene) { return scene.contains("unjudged"); });
}

// Where nothing could have shown a defect, there is nothing to say about them.
void add_known_defects(const KnownDefects& known, Json& results, SuiteOutcome* outcome) {
  const DefectComparison comparison =
      compare_defects(known, sightings_of(results), versions_in(results));
  outcome->unlisted_error = any_unlisted_error(comparison) || any_unjudged(results);
  const Json& scenes = results.at("scenes");
  const bool families = std::any_of(scenes.begin(), scenes.end(),
                                    [](const Json& scene) { return scene.contains("family"); });
  if (families || says_of_the_list(comparison, results))
    results["known_defects"] = to_json(known, comparison);
}

void append(Json from, Json& to) {
  for (Json& item : from) to.push_back(std::move(item));
}

std::uint64_t oracle_errors(const Json& scenes) {
  std::uint64_t sum = 0;
  for (const Json& scene : scenes)
    if (scene.contains("pairs"))
      sum += scene.at("pairs").at("rational").at("oracle_wrong").get<std::uint64_t>();
  return sum;
}

}  // namespace

SuiteOutput::SuiteOutput(fs::path out, fs::path scratch)
    : out_(std::move(out)), scratch_(std::move(scratch)) {}

void SuiteOutput::add(FinishedScene scene) {
  const auto id = scene.scene.at("id").get<std::string>();
  if (!scene.contacts.empty()) write_file_atomically(scratch_ / contacts_path(id), scene.contacts);
  scenes_.push_back(std::move(scene.scene));
  append(std::move(scene.runs), runs_);
  append(std::move(scene.disagreements), disagreements_);
}

Json SuiteOutput::results_of(const SuiteRecord& record, SuiteOutcome* outcome) const {
  Json results = record.head;
  results["scenes"] = scenes_;
  results["runs"] = runs_;
  results["disagreements"] = disagreements_;
  outcome->oracle_wrong = oracle_errors(scenes_);
  add_known_defects(record.known_defects, results, outcome);
  // Of a shard they would miss the scenes of the others.
  if (!record.goals.empty() && !record.shard)
    results["goals"] = measure_goals(record.goals, results);
  results.update(record.tail);
  return results;
}

NamedFiles SuiteOutput::named_files(const std::vector<fs::path>& cases) const {
  NamedFiles files;
  for (const Json& scene : scenes_)
    if (const std::string name = scene.value("contacts", ""); !name.empty())
      files[name] = scratch_ / name;
  for (const Json& run : runs_)
    if (const std::string name = run.value("recording", ""); !name.empty())
      files[name] = out_ / name;
  for (std::size_t i = 0; i < cases.size(); ++i)
    files[disagreements_.at(i).at("case").get<std::string>()] = cases[i];
  return files;
}

Json SuiteOutput::write(const SuiteRecord& record, SuiteOutcome* outcome) {
  const std::vector<fs::path> cases = number_cases(disagreements_);
  Json results = results_of(record, outcome);
  if (record.shard) results["shard"]["files"] = file_hashes(named_files(cases));
  // All is on disk before anything of an earlier run goes: from here on there are only renames.
  write_file_atomically(scratch_ / "results.json", results.dump(1) + "\n");
  remove_old_cases(out_);
  move_cases(out_, cases);
  move_contacts(out_, scratch_, scenes_);
  rename_file(scratch_ / "results.json", out_ / "results.json");
  return results;
}

}  // namespace contactcheck
