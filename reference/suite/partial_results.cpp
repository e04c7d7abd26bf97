#include "reference/suite/partial_results.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "core/types/hash.h"
#include "reference/results/results_file.h"
#include "reference/results/results_json.h"
#include "reference/suite/job.h"
#include "reference/suite/run_identity.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactcheck-partial/3";
constexpr std::string_view kSuffix = ".partial.json", kTemporary = ".tmp";

// Also what a run that was killed in the middle of writing has left.
bool is_ours(const std::string& name) {
  return name.ends_with(kSuffix) ||
         (name.find(kSuffix) != std::string::npos && name.ends_with(kTemporary));
}

}  // namespace

std::string identity_hash(const std::string& identity, const FinishedScene& scene,
                          const fs::path& out) {
  Fnv1a hash;
  hash.bytes(identity.data(), identity.size());
  // All rows of a scene have one recording.
  for (const results::Run& run : scene.runs) {
    if (run.recording.empty()) continue;
    const std::string recording = hash_of_file(out / run.recording);
    hash.bytes(recording.data(), recording.size());
    break;
  }
  return results::hex(hash.digest());
}

PartialResults::PartialResults(const fs::path& out, const fs::path& scratch)
    : out_(out), folder_(out / "partial"), scratch_(scratch) {}

fs::path PartialResults::file_of(const std::string& id) const {
  return folder_ / (id + std::string(kSuffix));
}

std::optional<PartialResults::File> PartialResults::read(const fs::path& path) const {
  File out;
  try {
    const Json file = Json::parse(read_text_file(path));
    if (file.at("schema") != kSchema) return std::nullopt;
    // The reader would take a missing list for an empty one.
    for (const char* list : {"scenes", "runs", "disagreements"}) file.at("results").at(list);
    results::Results results = results::from_json(file.at("results"));
    if (results.scenes.size() != 1) return std::nullopt;
    out.name = {results.scenes.front().id, file.at("identity").get<std::string>(),
                file.at("command").get<std::string>()};
    out.scene = {std::move(results.scenes.front()), std::move(results.runs),
                 std::move(results.disagreements), file.at("contacts").get<std::string>(),
                 file.at("hash").get<std::string>()};
    // A run that was stopped in the middle of the scene has left another recording.
    if (identity_hash(out.name.identity, out.scene, out_) != out.scene.hash) return std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
  return out;
}

std::vector<KeptScene> PartialResults::kept() const {
  std::vector<KeptScene> out;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    if (!entry.path().filename().string().ends_with(kSuffix) || !entry.is_regular_file(ignored))
      continue;
    if (std::optional<File> file = read(entry.path())) out.push_back(std::move(file->name));
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return out;
}

std::optional<FinishedScene> PartialResults::take(const KeptScene& wanted) {
  std::optional<File> file;
  if (fs::is_regular_file(file_of(wanted.id))) file = read(file_of(wanted.id));
  if (!file || file->name.identity != wanted.identity) {
    std::optional<FinishedScene> complete = take_complete(wanted);
    if (complete) keep(wanted, *complete);
    return complete;
  }
  std::size_t number = 0;
  for (results::Disagreement& d : file->scene.disagreements) {
    const fs::path text_file = scratch_ / (wanted.id + ".taken" + std::to_string(number++));
    write_file_atomically(text_file, d.case_file);
    d.case_file = text_file.string();
  }
  return std::move(file->scene);
}

std::optional<FinishedScene> PartialResults::take_complete(const KeptScene& wanted) {
  if (!complete_) {
    complete_.emplace();
    const fs::path file = out_ / "results.json";
    try {
      if (fs::is_regular_file(file)) complete_ = results::results_in(file);
    } catch (const InputError&) {
      // A damaged file is none.
    }
  }
  const results::Index rows(*complete_);
  if (!complete_->identities.contains(wanted.id) || rows.scene(wanted.id) == nullptr)
    return std::nullopt;
  try {
    FinishedScene scene = finished_scene(rows, wanted.id, out_, scratch_);
    if (identity_hash(wanted.identity, scene, out_) == scene.hash) return scene;
  } catch (const InputError&) {
    // A file that the scene names is gone.
  }
  return std::nullopt;
}

void PartialResults::keep(const KeptScene& name, const FinishedScene& scene) const {
  results::Results results;
  results.scenes = {scene.scene};
  results.runs = scene.runs;
  results.disagreements = scene.disagreements;
  // In the file a case stands itself, in place of its path.
  for (results::Disagreement& d : results.disagreements) d.case_file = read_text_file(d.case_file);
  const Json file = {{"schema", kSchema},
                     {"identity", name.identity},
                     {"hash", scene.hash},
                     {"command", name.command},
                     {"results", results::to_json(results)},
                     {"contacts", scene.contacts}};
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw InputError("cannot write in " + folder_.string() + ": " + error.message());
  write_file_atomically(file_of(name.id), file.dump() + "\n");
}

void PartialResults::clear() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (entry.is_regular_file(ignored) && is_ours(entry.path().filename().string()))
      fs::remove(entry.path(), ignored);
  fs::remove(folder_, ignored);
}

}  // namespace contactcheck::suite
