#include "reference/scene/catalogue.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <system_error>

#include "core/types/check.h"
#include "core/types/suggestion.h"
#include "reference/text/file_text.h"
#include "reference/text/id_check.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

}  // namespace

fs::path installed_fixtures(const fs::path& program) {
  return (program.parent_path() / CONTACTCHECK_FIXTURES_FROM_PROGRAM).lexically_normal();
}

std::vector<fs::path> shared_fixtures(const std::string& data_folders) {
  std::vector<fs::path> found;
  std::istringstream folders(data_folders);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::path(folder).is_absolute())
      found.push_back(fs::path(folder) / "contactcheck" / "fixtures");
  return found;
}

fs::path fixtures_directory() {
  const std::string own = environment("CONTACTCHECK_FIXTURES", "");
  if (!own.empty()) return own;
  std::error_code ignored;
  std::vector<fs::path> candidates = {
      installed_fixtures(fs::read_symlink("/proc/self/exe", ignored)),
      CONTACTCHECK_FIXTURES_BUILT_FROM};
  for (const fs::path& each :
       shared_fixtures(environment("XDG_DATA_DIRS", "/usr/local/share:/usr/share")))
    candidates.push_back(each);
  for (const fs::path& each : candidates)
    if (each.is_absolute() && fs::is_directory(each, ignored)) return each;
  return CONTACTCHECK_FIXTURES_BUILT_FROM;
}

CatalogueEntry read_entry(const fs::path& file, const std::string& kind) {
  const std::string document = kind + " file " + text::in_quotes(file.string());
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, kind + " file"), document);
  const text::JsonField root(value, document);
  const text::JsonField id = root.at("id");
  if (text::parse_id(id) != file.stem().string()) {
    id.refuse("the file's name without its extension, " + text::in_quotes(file.stem().string()));
  }
  return {id.text(), root.has("title") ? root.at("title").text() : id.text(), file};
}

namespace {

std::vector<CatalogueEntry> list_folder(const fs::path& folder, const std::string& kind) {
  if (!fs::is_directory(folder)) {
    throw InputError("folder " + text::in_quotes(folder.string()) + " with files of the kind " +
                     kind + " does not exist; $CONTACTCHECK_FIXTURES says where fixtures are.");
  }
  std::vector<CatalogueEntry> entries;
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    if (file.path().extension() == ".json") entries.push_back(read_entry(file.path(), kind));
  }
  std::sort(entries.begin(), entries.end(),
            [](const CatalogueEntry& a, const CatalogueEntry& b) { return a.id < b.id; });
  return entries;
}

// The file of an id in a folder, found by name alone: no other file is read.
std::optional<fs::path> file_of_id(const fs::path& folder, const std::string& id) {
  if (!text::is_id(id)) return std::nullopt;
  const fs::path file = folder / (id + ".json");
  if (!fs::is_regular_file(file)) return std::nullopt;
  return file;
}

// The folders of scenes, hard cases and families over scales.
std::vector<fs::path> scene_folders(const fs::path& fixtures) {
  return {fixtures / "scenes", fixtures / "hard" / "families", fixtures / "scales"};
}

std::optional<fs::path> scene_or_family(const fs::path& fixtures, const std::string& id) {
  for (const fs::path& folder : scene_folders(fixtures))
    if (auto file = file_of_id(folder, id)) return file;
  return std::nullopt;
}

std::vector<std::string> ids_in(const fs::path& folder) {
  std::vector<std::string> ids;
  std::error_code ignored;
  for (const fs::directory_entry& file : fs::directory_iterator(folder, ignored)) {
    if (file.path().extension() == ".json") ids.push_back(file.path().stem().string());
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

bool is_suite_file(const fs::path& file) {
  const std::string document = "scene file " + text::in_quotes(file.string());
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, "scene file"), document);
  return value.kind == text::JsonValue::Kind::kObject && value.find("scenes") != nullptr;
}

}  // namespace

std::vector<CatalogueEntry> list_scenes(const fs::path& fixtures) {
  return list_folder(fixtures / "scenes", "scene");
}

std::vector<CatalogueEntry> list_suites(const fs::path& fixtures) {
  return list_folder(fixtures / "suites", "suite");
}

std::vector<CatalogueEntry> list_families(const fs::path& fixtures) {
  return list_folder(fixtures / "hard" / "families", "family");
}

std::vector<CatalogueEntry> list_scale_families(const fs::path& fixtures) {
  return list_folder(fixtures / "scales", "family");
}

Target find_target(const std::string& name, const fs::path& fixtures) {
  if (const auto suite = file_of_id(fixtures / "suites", name)) {
    return {TargetKind::kSuite, *suite};
  }
  if (const auto scene = scene_or_family(fixtures, name)) {
    return {TargetKind::kScene, *scene};
  }
  const fs::path file(name);
  std::error_code ignored;  // a link to itself, a name that is too long: no such file
  if (file.extension() == ".ccr" && fs::exists(file, ignored))
    return {TargetKind::kRecording, file};
  if (file.extension() == ".json" && fs::exists(file, ignored)) {
    return {is_suite_file(file) ? TargetKind::kSuite : TargetKind::kScene, file};
  }
  if (file.extension() == ".ccr" || file.extension() == ".json")
    throw InputError(text::in_quotes(name) + " does not exist.");
  std::vector<std::string> ids = ids_in(fixtures / "suites");
  for (const fs::path& folder : scene_folders(fixtures))
    for (std::string& id : ids_in(folder)) ids.push_back(std::move(id));
  throw InputError(text::in_quotes(name) +
                   " is no suite, scene, family of hard cases, .json or .ccr file; " +
                   suggestion(name, ids) + "`contactcheck list` names all.");
}

fs::path find_scene(const std::string& id, const fs::path& fixtures) {
  if (const auto file = scene_or_family(fixtures, id)) return *file;
  throw InputError("there is no scene " + text::in_quotes(id) + "; " +
                   suggestion(id, ids_in(fixtures / "scenes")) + "`contactcheck list` names all.");
}

}  // namespace contactcheck::scene
