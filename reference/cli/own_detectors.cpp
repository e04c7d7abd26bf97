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

class BringIn {
 public:
  BringIn(const suite::RunSettings& settings, const DetectorCatalog& catalog)
      : settings_(settings) {
    own_.catalog = catalog;
  }

  // Commands come first: their detectors may be named, with options, among the others.
  OwnDetectors of(const std::vector<std::string>& detectors,
                  const std::vector<std::string>& commands) {
    std::vector<std::string> ids;
    for (const std::string& command : commands)
      ids.push_back(id_of({plugin::PluginKind::kCommand, command}));
    for (const std::string& detector : detectors)
      own_.names.push_back(names_library(detector) ? name_in_library(detector) : detector);
    for (const std::string& id : ids)
      if (!named(id)) own_.names.push_back(id);
    return std::move(own_);
  }

 private:
  std::string name_in_library(const std::string& text) {
    const std::size_t end = end_of_file_name(text);
    const fs::path file = fs::absolute(text.substr(0, end)).lexically_normal();
    return id_of({plugin::PluginKind::kLibrary, file.string()}) + text.substr(end);
  }

  std::string id_of(const plugin::PluginSource& source) {
    for (const plugin::Plugin& known : own_.plugins)
      if (known.source.kind == source.kind && known.source.text == source.text)
        return known.declaration.id;
    static const fs::path executable = fs::read_symlink("/proc/self/exe");
    own_.plugins.push_back(plugin::examine_plugin(source, executable, settings_));
    plugin::add_plugin(own_.plugins.back(), own_.catalog);
    return own_.plugins.back().declaration.id;
  }

  bool named(const std::string& id) const {
    return std::any_of(own_.names.begin(), own_.names.end(), [&](const std::string& name) {
      return name.substr(0, name.find(':')) == id;
    });
  }

  const suite::RunSettings& settings_;
  OwnDetectors own_;
};

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
  return BringIn(settings, catalog).of(detectors, commands);
}

}  // namespace contactcheck::cli
