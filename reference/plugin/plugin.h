// A detector from outside this program: where it comes from, what its bytes are, what it says
// about itself.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/plugin/declaration.h"
#include "reference/suite/job.h"

namespace contactcheck::plugin {

enum class PluginKind { kLibrary, kCommand };

struct PluginSource {
  PluginKind kind = PluginKind::kLibrary;
  std::string text;  ///< absolute path of a shared library, or a command
};

const char* name_of(PluginKind kind);  ///< library, command
/// @throws InputError for another word
PluginKind plugin_kind_from_name(const std::string& name);

/// 'library "/path/libmine.so"', 'command "python3 mine.py"'
std::string described(const PluginSource& source);

/// Hash of a library's file; of a command's text and of the files that its words name.
/// @throws InputError when the library cannot be read
std::string content_of(const PluginSource& source);

struct Plugin {
  PluginSource source;
  std::string content;
  Declaration declaration;
};

nlohmann::ordered_json to_json(const Plugin& plugin);
/// @throws InputError for what to_json has not written
Plugin plugin_from_text(const std::string& json);

/// Adds its detector. Nothing of it is loaded or started before one is made.
/// @throws InputError for an id that is taken or reserved, and for options that contradict
/// themselves
void add_plugin(const Plugin& plugin, DetectorCatalog& catalog);

/// `catalog` and the detectors of these records (texts of to_json), as a worker is handed them.
DetectorCatalog with_plugins(const DetectorCatalog& catalog,
                             const std::vector<std::string>& records);

/// What results.json says of them: id, kind, file name or command, content, version.
std::vector<results::Plugin> plugins_in_results(const std::vector<Plugin>& plugins);

}  // namespace contactcheck::plugin
