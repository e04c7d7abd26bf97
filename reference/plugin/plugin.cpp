#include "reference/plugin/plugin.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "core/types/hash.h"
#include "reference/adapters/register.h"
#include "reference/plugin/pipe_detector.h"
#include "reference/plugin/plugin_library.h"
#include "reference/results/results.h"
#include "reference/suite/job.h"
#include "reference/text/shell_word.h"

namespace contactcheck::plugin {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibrary = "library";
constexpr const char* kCommand = "command";
constexpr const char* kOracle = "oracle";  // under this name results.json lists its errors

void add_file(const fs::path& file, Fnv1a& hash) {
  const std::string bytes = suite::read_text_file(file);
  hash.bytes(bytes.data(), bytes.size());
}

DetectorInfo frame_detector(const Plugin& plugin) {
  DetectorInfo info;
  info.id = plugin.declaration.id;
  info.summary = plugin.declaration.summary;
  info.options = plugin.declaration.options;
  info.make = [source = plugin.source, id = info.id](const Options& options) {
    return source.kind == PluginKind::kLibrary
               ? make_library_detector(PluginLibrary(source.text), options)
               : make_pipe_detector(source.text, id, options);
  };
  return info;
}

ImpactDetectorInfo impact_detector(const Plugin& plugin) {
  ImpactDetectorInfo info;
  info.id = plugin.declaration.id;
  info.summary = plugin.declaration.summary;
  info.options = plugin.declaration.options;
  info.precision = plugin.declaration.impacts->precision;
  info.kinds = plugin.declaration.impacts->kinds;
  info.make = [source = plugin.source, id = info.id,
               declared = *plugin.declaration.impacts](const Options& options) {
    return source.kind == PluginKind::kLibrary
               ? make_library_impact_detector(PluginLibrary(source.text), options, declared)
               : make_pipe_impact_detector(source.text, id, options);
  };
  return info;
}

}  // namespace

const char* name_of(PluginKind kind) { return kind == PluginKind::kLibrary ? kLibrary : kCommand; }

PluginKind plugin_kind_from_name(const std::string& name) {
  for (const PluginKind kind : {PluginKind::kLibrary, PluginKind::kCommand})
    if (name == name_of(kind)) return kind;
  throw InputError("\"" + name + "\" is no kind of plug-in");
}

std::string described(const PluginSource& source) {
  return std::string(name_of(source.kind)) + " \"" + source.text + "\"";
}

std::string content_of(const PluginSource& source) {
  Fnv1a hash;
  if (source.kind == PluginKind::kLibrary) {
    add_file(source.text, hash);
  } else {
    hash.bytes(source.text.data(), source.text.size());
    for (const std::string& word : text::shell_words(source.text)) {
      std::error_code ignored;  // a script is edited and its command line stays
      if (fs::is_regular_file(word, ignored)) add_file(word, hash);
    }
  }
  return results::hex(hash.digest());
}

nlohmann::ordered_json to_json(const Plugin& plugin) {
  return {{"kind", name_of(plugin.source.kind)},
          {"source", plugin.source.text},
          {"content", plugin.content},
          {"declaration", to_json(plugin.declaration)}};
}

Plugin plugin_from_text(const std::string& json) {
  const std::string document = "record of a detector";
  const text::JsonValue value = text::parse_json(json, document);
  const text::JsonField field(value, document);
  Plugin plugin;
  plugin.source = {plugin_kind_from_name(field.at("kind").text()), field.at("source").text()};
  plugin.content = field.at("content").text();
  plugin.declaration = read_declaration(field.at("declaration"));
  return plugin;
}

void add_plugin(const Plugin& plugin, DetectorCatalog& catalog) {
  // Under the name of another detector, or of a library whose known defects are listed, results
  // would be taken for theirs.
  const Declaration& declaration = plugin.declaration;
  const std::string& id = declaration.id;
  const std::string claim = described(plugin.source) + " calls itself \"" + id + "\", ";
  // Detectors of frames and of queries are asked for apart, so one of each may have a name.
  if ((declaration.answers_frames() && catalog.find(id) != nullptr) ||
      (declaration.impacts && catalog.find_impact(id) != nullptr))
    throw InputError(claim + "which is another detector's name; change the id that it declares");
  if (id == kOracle || adapters::library_of(id) != "contactcheck")
    throw InputError(claim + "a name that is kept for " +
                     (id == kOracle ? "the oracle" : adapters::library_of(id)));
  try {
    if (declaration.answers_frames()) catalog.add(frame_detector(plugin));
    if (declaration.impacts) catalog.add(impact_detector(plugin));
  } catch (const InputError& e) {
    throw InputError(described(plugin.source) + " cannot be used: " + e.what());
  }
}

DetectorCatalog with_plugins(const DetectorCatalog& catalog,
                             const std::vector<std::string>& records) {
  DetectorCatalog out = catalog;
  for (const std::string& record : records) add_plugin(plugin_from_text(record), out);
  return out;
}

std::vector<results::Plugin> plugins_in_results(const std::vector<Plugin>& plugins) {
  std::vector<results::Plugin> out;
  for (const Plugin& plugin : plugins) {
    const bool library = plugin.source.kind == PluginKind::kLibrary;
    const std::string& text = plugin.source.text;
    out.push_back({plugin.declaration.id, name_of(plugin.source.kind),
                   library ? fs::path(text).filename().string() : text, plugin.content,
                   plugin.declaration.version, plugin.declaration.unisolated,
                   plugin.declaration.transient});
  }
  return out;
}

}  // namespace contactcheck::plugin
