// The data of contactcheck: its folder, the scenes and suites in it, and finding what a user named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contactcheck::scene {

/// The folder that contains scenes/, suites/, hard/, paper/ and policies/: $CONTACTCHECK_FIXTURES
/// if set; else the first that exists of the data installed with the running program, the source
/// tree of this build, and contactcheck/fixtures in $XDG_DATA_DIRS (default /usr/local/share and
/// /usr/share), for programs that link the library. If none exists: that of the source tree, which
/// the error message then names.
std::filesystem::path fixtures_directory();

/// The data folder of an installed program; `program` is its path.
std::filesystem::path installed_fixtures(const std::filesystem::path& program);

/// The folders, in order, from a list separated by ':' as in $XDG_DATA_DIRS; empty and relative
/// ones are left out, as its specification says.
std::vector<std::filesystem::path> shared_fixtures(const std::string& data_folders);

struct CatalogueEntry {
  std::string id;  ///< equal to the file's name without ".json"
  std::string title;
  std::filesystem::path file;
};

/// Reads id and title. `kind` names the file in messages: "scene". @throws InputError as below
CatalogueEntry read_entry(const std::filesystem::path& file, const std::string& kind);

/// Sorted by id; reads no mesh. @throws InputError if the folder is missing, or a file is not a
/// JSON object or has another id than its name
std::vector<CatalogueEntry> list_scenes(const std::filesystem::path& fixtures);
/// Families of hard cases, whose expected answers are stored, and families over scales, which every
/// run judges anew. Both can be named like scenes.
std::vector<CatalogueEntry> list_families(const std::filesystem::path& fixtures);
std::vector<CatalogueEntry> list_scale_families(const std::filesystem::path& fixtures);
std::vector<CatalogueEntry> list_suites(const std::filesystem::path& fixtures);

enum class TargetKind { kScene, kSuite, kRecording };

struct Target {
  TargetKind kind = TargetKind::kScene;
  std::filesystem::path file;
};

/// Finds what `name` means: the id of a suite, scene or family, or the path of a file: .ccr is a
/// recording; .json is a suite if it has the key "scenes", else a scene.
/// @throws InputError that suggests similar ids
Target find_target(const std::string& name, const std::filesystem::path& fixtures);

/// The file of a scene's or family's id, as suites name them. @throws InputError that suggests
/// similar ids
std::filesystem::path find_scene(const std::string& id, const std::filesystem::path& fixtures);

}  // namespace contactcheck::scene
