#include "reference/run/partial_results.h"

#include <algorithm>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/run/job.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactcheck-partial/1";
constexpr std::string_view kSuffix = ".partial.json", kTemporary = ".tmp";

// Also what a run that was killed in the middle of writing has left.
bool is_ours(const std::string& name) {
  return name.ends_with(kSuffix) ||
         (name.find(kSuffix) != std::string::npos && name.ends_with(kTemporary));
}

bool recordings_exist(const fs::path& out, const Json& runs) {
  return std::all_of(runs.begin(), runs.end(), [&](const Json& run) {
    return !run.contains("recording") || fs::exists(out / run.at("recording").get<std::string>());
  });
}

}  // namespace

PartialResults::PartialResults(const fs::path& out, const fs::path& scratch)
    : out_(out), folder_(out / "partial"), scratch_(scratch) {}

fs::path PartialResults::file_of(const std::string& id) const {
  return folder_ / (id + std::string(kSuffix));
}

std::optional<FinishedScene> PartialResults::take(const std::string& id,
                                                  const Json& identity) const {
  if (!fs::is_regular_file(file_of(id))) return std::nullopt;
  try {
    Json file = Json::parse(read_text_file(file_of(id)));
    if (file.at("schema") != kSchema || file.at("identity") != identity) return std::nullopt;
    if (!recordings_exist(out_, file.at("runs"))) return std::nullopt;
    return unpacked(id, std::move(file));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

FinishedScene PartialResults::unpacked(const std::string& id, Json file) const {
  FinishedScene scene;
  scene.scene = std::move(file.at("scene"));
  scene.runs = std::move(file.at("runs"));
  file.at("contacts").get_to(scene.contacts);
  std::size_t number = 0;
  for (Json& d : file.at("disagreements")) {
    const fs::path text_file = scratch_ / (id + ".resumed" + std::to_string(number++));
    write_file_atomically(text_file, d.at("case").get<std::string>());
    d["case"] = text_file.string();
    scene.disagreements.push_back(std::move(d));
  }
  return scene;
}

void PartialResults::keep(const std::string& id, const Json& identity,
                          const FinishedScene& scene) const {
  Json disagreements = scene.disagreements;
  for (Json& d : disagreements) d["case"] = read_text_file(d.at("case").get<std::string>());
  const Json file = {{"schema", kSchema},
                     {"identity", identity},
                     {"scene", scene.scene},
                     {"runs", scene.runs},
                     {"disagreements", std::move(disagreements)},
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

}  // namespace contactcheck
