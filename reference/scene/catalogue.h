// The data that comes with contactcheck: the folder that holds it, the scenes and suites in it, and
// finding what a user named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contactcheck::scene {

/// The folder of scenes/, suites/, hard/, paper/ and policies/:
/// $CONTACTCHECK_FIXTURES where it is set; else the first that is a folder of: the data installed
/// with the running program, the source tree this was built from, and contactcheck/fixtures in
/// $XDG_DATA_DIRS (default /usr/local/share and /usr/share), for programs of others that link the
/// library. None is: that of the source tree, for the sentence that says what is missing.
std::filesystem::path fixtures_directory();

/// The data of a program that was installed: `program` is its path.
std::filesystem::path installed_fixtures(const std::filesystem::path& program);

/// In order, from a list separated by ':' as in $XDG_DATA_DIRS; empty or relative folders are left
/// out, as its specification says.
std::vector<std::filesystem::path> shared_fixtures(const std::string& data_folders);

struct CatalogueEntry {
  std::string id;  ///< equal to the file's name without ".json"
  std::string title;
  std::filesystem::path file;
};

/// `kind` names the file in messages: "scene". @throws InputError as the next
CatalogueEntry read_entry(const std::filesystem::path& file, const std::string& kind);

/// Sorted by id. Reads no mesh. @throws InputError when the folder is missing, or a file is no JSON
/// object or has another id than its name
std::vector<CatalogueEntry> list_scenes(const std::filesystem::path& fixtures);
/// Families of hard cases, whose answers are kept, and those over scales, for which every run is
/// judged anew. Both can be named wherever scenes can.
std::vector<CatalogueEntry> list_families(const std::filesystem::path& fixtures);
std::vector<CatalogueEntry> list_scale_families(const std::filesystem::path& fixtures);
std::vector<CatalogueEntry> list_suites(const std::filesystem::path& fixtures);

enum class TargetKind { kScene, kSuite, kRecording };

struct Target {
  TargetKind kind = TargetKind::kScene;
  std::filesystem::path file;
};

/// What `name` stands for: the id of a suite, the id of a scene or of a family, or the path of a
/// file: .ccr is a recording, .json a suite when it has the key "scenes" and a scene otherwise.
/// @throws InputError with ids that are near
Target find_target(const std::string& name, const std::filesystem::path& fixtures);

/// The file of a scene's or family's id, as suites name them. @throws InputError with ids that are
/// near
std::filesystem::path find_scene(const std::string& id, const std::filesystem::path& fixtures);

}  // namespace contactcheck::scene
