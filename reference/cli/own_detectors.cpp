#include "reference/cli/own_detectors.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "reference/plugin/examination.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

// Where a library's file ends and its options begin: at a ':', and paths may hold some. The longest
// beginning that is a file is meant; without any, the shortest.
std::size_t end_of_file_name(const std::string& text) {
  for (std::size_t end = text.size(); end != std::string::npos && end > 0;
       end = text.rfind(':', end - 1)) {
    std::error_code ignored;
    if (fs::is_regular_file(text.substr(0, end), ignored)) return end;
  }
  return std::min(text.find(':'), text.size());
}

}  // namespace

std::vector<std::string> OwnDetectors::records() const {
  std::vector<std::string> out;
  for (const plugin::Plugin& plugin : plugins) out.push_back(plugin::to_json(plugin).dump());
  return out;
}

std::vector<std::string> OwnDetectors::ids() const {
  std::vector<std::string> out;
  for (const plugin::Plugin& plugin : plugins) out.push_back(plugin.declaration.id);
  return out;
}

bool names_library(const std::string& text) {
  const std::string file = text.substr(0, text.find(':'));
  return file.find('/') != std::string::npos || file.ends_with(".so");
}

OwnDetectors load_own_detectors(const std::vector<std::string>& detectors,
                                const std::vector<std::string>& commands,
                                const suite::RunSettings& settings,
                                const DetectorCatalog& catalog) {
  OwnDetectors own;
  own.catalog = catalog;
  const auto id_of = [&](const plugin::PluginSource& source) {
    for (const plugin::Plugin& known : own.plugins)
      if (known.source.kind == source.kind && known.source.text == source.text)
        return known.declaration.id;
    static const fs::path executable = fs::read_symlink("/proc/self/exe");
    own.plugins.push_back(plugin::examine_plugin(source, executable, settings));
    plugin::add_plugin(own.plugins.back(), own.catalog);
    return own.plugins.back().declaration.id;
  };
  // Commands come first: their detectors may be named, with options, among the others.
  std::vector<std::string> ids;
  for (const std::string& command : commands)
    ids.push_back(id_of({plugin::PluginKind::kCommand, command}));
  for (const std::string& detector : detectors) {
    if (!names_library(detector)) {
      own.names.push_back(detector);
      continue;
    }
    const std::size_t end = end_of_file_name(detector);
    const fs::path file = fs::absolute(detector.substr(0, end)).lexically_normal();
    own.names.push_back(id_of({plugin::PluginKind::kLibrary, file.string()}) +
                        detector.substr(end));
  }
  for (const std::string& id : ids)
    if (std::ranges::none_of(own.names, [&](const std::string& name) {
          return name.substr(0, name.find(':')) == id;
        }))
      own.names.push_back(id);
  return own;
}

}  // namespace contactcheck::cli
