// A scene file with every body changed in one way.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// One body as the scene file has it; `document` names the file in messages.
using ChangeBody = std::function<void(nlohmann::ordered_json& body, const std::string& document)>;

/// Writes the scene of `file` with its bodies changed into `folder`; the id gets "-SUFFIX" behind
/// it. Returns the new file, which may be read from anywhere.
/// @throws InputError for what is no scene file, and what `change` throws
std::filesystem::path write_scene_variant(const std::filesystem::path& file,
                                          const std::string& suffix, const ChangeBody& change,
                                          const std::filesystem::path& folder);

}  // namespace contactcheck
