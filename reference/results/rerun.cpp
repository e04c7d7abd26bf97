#include "reference/results/rerun.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include "reference/text/shell_word.h"

namespace contactcheck::results {
namespace {

namespace fs = std::filesystem;

// The flags of `run` without a value.
constexpr const char* kWithoutValue[] = {"--no-timing",  "--reduce",     "--resume",
                                         "--overwrite",  "--quiet",      "--explain",
                                         "--json-lines", "--closed-loop"};

/// A command's flags with their values, and words without a flag.
std::vector<std::pair<std::string, std::string>> flags_of(const std::string& command) {
  const std::vector<std::string> words = text::shell_words(command);
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t equals = words[i].find('=');
    if (!words[i].starts_with("--")) {
      out.emplace_back("", words[i]);
    } else if (equals != std::string::npos) {
      out.emplace_back(words[i].substr(0, equals), words[i].substr(equals + 1));
    } else if (std::find(std::begin(kWithoutValue), std::end(kWithoutValue), words[i]) !=
               std::end(kWithoutValue)) {
      out.emplace_back(words[i], "");
    } else if (i + 1 < words.size()) {
      out.emplace_back(words[i], words[i + 1]);
      ++i;
    }
  }
  return out;
}

}  // namespace

std::string detector_words(const Results& results, const std::string& detector) {
  const Plugin* const plugin = results.plugin_of(detector);
  if (plugin != nullptr && plugin->transient) return "";
  if (plugin != nullptr && plugin->kind == "command")
    return "--detector-cmd " + text::in_shell(plugin->source);
  if (plugin != nullptr)
    for (const auto& [flag, word] : flags_of(results.command)) {
      const std::string file = word.substr(0, word.find(':'));
      if (flag == "--detector" && fs::path(file).filename() == plugin->source)
        return "--detector " + text::in_shell(file + detector.substr(plugin->detector.size()));
    }
  return "--detector " + text::in_shell(detector);
}

std::string scene_words(const Results& results, const std::string& scene) {
  std::string meshes, motion = "approach", options;
  for (const auto& [flag, word] : flags_of(results.command)) {
    const fs::path path(word);
    const bool scene_file = path.extension() == ".json" || path.extension() == ".ccr";
    if (flag.empty() && scene_file && path.stem() == scene) return text::in_shell(word);
    if ((flag.empty() && path.has_extension() && !scene_file) || flag == "--mesh")
      meshes += (meshes.empty() ? "" : " ") + text::in_shell(word);
    if (flag == "--motion") motion = word;
    if (flag == "--motion" || flag == "--size") options += " " + flag + " " + text::in_shell(word);
  }
  const bool of_meshes = !meshes.empty() && scene.ends_with("-" + motion);
  return of_meshes ? meshes + options : text::in_shell(scene);
}

std::string out_folder(const Results& results) {
  std::string out = "out";
  for (const auto& [flag, word] : flags_of(results.command))
    if (flag == "--out") out = word;
  return out;
}

bool failed_in_a_frame(const Run& row) {
  return row.status == Status::kError && row.failed_frame && !row.recording.empty() &&
         !any_impact(row.semantics.levels) && !row.message.ends_with(kWhileTimed) &&
         (row.message.find("phase prepare: in frame ") == std::string::npos ||
          row.message.find(kOfWarmUp) == std::string::npos);
}

}  // namespace contactcheck::results
