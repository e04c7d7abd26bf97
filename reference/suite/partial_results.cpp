#include "reference/suite/partial_results.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/results/results_json.h"
#include "reference/suite/job.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactcheck-partial/2";
constexpr std::string_view kSuffix = ".partial.json", kTemporary = ".tmp";

// Also what a run that was killed in the middle of writing has left.
bool is_ours(const std::string& name) {
  return name.ends_with(kSuffix) ||
         (name.find(kSuffix) != std::string::npos && name.ends_with(kTemporary));
}

bool recordings_exist(const fs::path& out, const std::vector<results::Run>& runs) {
  return std::all_of(runs.begin(), runs.end(), [&](const results::Run& run) {
    return run.recording.empty() || fs::exists(out / run.recording);
  });
}

}  // namespace

PartialResults::PartialResults(const fs::path& out, const fs::path& scratch)
    : out_(out), folder_(out / "partial"), scratch_(scratch) {}

fs::path PartialResults::file_of(const std::string& id) const {
  return folder_ / (id + std::string(kSuffix));
}

std::optional<FinishedScene> PartialResults::take(const std::string& id,
                                                  const std::string& identity) const {
  if (!fs::is_regular_file(file_of(id))) return std::nullopt;
  FinishedScene scene;
  try {
    const Json file = Json::parse(read_text_file(file_of(id)));
    if (file.at("schema") != kSchema || file.at("identity") != identity) return std::nullopt;
    // The reader would take a missing list for an empty one.
    for (const char* list : {"scenes", "runs", "disagreements"}) file.at("results").at(list);
    results::Results results = results::from_json(file.at("results"));
    if (results.scenes.size() != 1) return std::nullopt;
    scene = {std::move(results.scenes.front()), std::move(results.runs),
             std::move(results.disagreements), file.at("contacts").get<std::string>()};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  if (!recordings_exist(out_, scene.runs)) return std::nullopt;
  std::size_t number = 0;
  for (results::Disagreement& d : scene.disagreements) {
    const fs::path text_file = scratch_ / (id + ".resumed" + std::to_string(number++));
    write_file_atomically(text_file, d.case_file);
    d.case_file = text_file.string();
  }
  return scene;
}

void PartialResults::keep(const std::string& id, const std::string& identity,
                          const FinishedScene& scene) const {
  results::Results results;
  results.scenes = {scene.scene};
  results.runs = scene.runs;
  results.disagreements = scene.disagreements;
  // In the file a case stands itself, in place of its path.
  for (results::Disagreement& d : results.disagreements) d.case_file = read_text_file(d.case_file);
  const Json file = {{"schema", kSchema},
                     {"identity", identity},
                     {"results", results::to_json(results)},
                     {"contacts", scene.contacts}};
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw InputError("cannot write in " + folder_.string() + ": " + error.message());
  write_file_atomically(file_of(id), file.dump() + "\n");
}

void PartialResults::drop(const std::string& id) const {
  std::error_code ignored;
  fs::remove(file_of(id), ignored);
}

void PartialResults::clear() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (entry.is_regular_file(ignored) && is_ours(entry.path().filename().string()))
      fs::remove(entry.path(), ignored);
  fs::remove(folder_, ignored);
}

}  // namespace contactcheck::suite
