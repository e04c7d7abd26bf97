// A scene file with something changed.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck::tune {

/// The scene as its file has it, with an array "bodies"; `document` names the file in messages.
using ChangeScene = std::function<void(nlohmann::ordered_json& scene, const std::string& document)>;

/// Writes the scene of `file`, changed, into `folder`; the id gets "-SUFFIX" behind
/// it. Returns the new file, which may be read from anywhere.
/// @throws InputError for what is no scene file, and what `change` throws
std::filesystem::path write_scene_variant(const std::filesystem::path& file,
                                          const std::string& suffix, const ChangeScene& change,
                                          const std::filesystem::path& folder);

}  // namespace contactcheck::tune
