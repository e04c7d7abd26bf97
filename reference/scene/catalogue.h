// The scenes and suites that come with contactcheck, and finding what a user named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/scene/fixtures_folder.h"

namespace contactcheck::scene {

struct CatalogueEntry {
  std::string id;  ///< equal to the file's name without ".json"
  std::string title;
  std::filesystem::path file;
};

/// Sorted by id. Reads no mesh. @throws InputError when the folder is missing, or a file is no JSON
/// object or has another id than its name
std::vector<CatalogueEntry> list_scenes(const std::filesystem::path& fixtures);
/// Families of hard cases, which can be named wherever scenes can.
std::vector<CatalogueEntry> list_families(const std::filesystem::path& fixtures);
std::vector<CatalogueEntry> list_suites(const std::filesystem::path& fixtures);

enum class TargetKind { kScene, kSuite, kRecording };

struct Target {
  TargetKind kind = TargetKind::kScene;
  std::filesystem::path file;
};

/// What `name` stands for: the id of a suite, the id of a scene or of a family, or the path of a
/// file: .ccr is a recording, .json a suite when it has the key "scenes" and a scene otherwise.
/// @throws InputError with the ids there are
Target find_target(const std::string& name, const std::filesystem::path& fixtures);

/// The file of a scene's or family's id, as suites name them. @throws InputError with the ids there
/// are
std::filesystem::path find_scene(const std::string& id, const std::filesystem::path& fixtures);

}  // namespace contactcheck::scene
