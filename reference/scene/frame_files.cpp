#include "reference/scene/frame_files.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/deform/name_check.h"
#include "core/types/check.h"
#include "reference/text/file_text.h"
#include "reference/text/shell_word.h"

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostDigits = 9;  // of a number in a recording

/// A path with one number taken out.
struct Numbered {
  std::string before, digits, after;
  std::pair<std::string, std::string> key() const { return {before, after}; }
  std::size_t number() const { return std::stoul(digits); }
};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Of the file's own name, without its extension.
std::vector<Numbered> numbers_in(const fs::path& file) {
  const std::string path = file.string();
  const std::size_t end = path.size() - file.extension().string().size();
  std::size_t at = path.size() - file.filename().string().size();
  std::vector<Numbered> out;
  while (at < end) {
    std::size_t to = at;
    while (to < end && is_digit(path[to])) ++to;
    if (to > at && to - at <= kMostDigits)
      out.push_back({path.substr(0, at), path.substr(at, to - at), path.substr(to)});
    at = to > at ? to : at + 1;
  }
  return out;
}

bool is_cache(const fs::path& file) {
  return file.extension() == ".pc2" || file.extension() == ".mdd";
}

/// What is known of a body before its files are read.
struct BodyFiles {
  std::string stem, folder;  ///< what its name is made of
  std::optional<Numbered> pattern;
  std::vector<std::string> digits;  ///< with a pattern
  fs::path mesh, cache;             ///< without one
};

std::string shown(const Numbered& pattern) {
  return text::in_quotes(pattern.before + "%d" + pattern.after);
}

std::string shown_files(const BodyFiles& body) {
  const auto word = [](const std::string& part) {
    return part.empty() ? "" : text::in_shell(part);
  };
  if (body.pattern) return word(body.pattern->before) + "*" + word(body.pattern->after);
  return word(body.mesh.string()) + (body.cache.empty() ? "" : " " + word(body.cache.string()));
}

Json recording_of(BodyFiles& body, std::vector<std::string>& files) {
  const Numbered& pattern = *body.pattern;
  std::sort(body.digits.begin(), body.digits.end(), [](const std::string& a, const std::string& b) {
    return std::stoul(a) < std::stoul(b);
  });
  std::size_t width = 0;  // of numbers with leading zeros
  for (const std::string& digits : body.digits)
    if (digits.size() > 1 && digits[0] == '0')
      width = width == 0 ? digits.size() : std::min(width, digits.size());
  std::vector<std::size_t> numbers;
  for (const std::string& digits : body.digits) numbers.push_back(std::stoul(digits));
  const std::size_t step = numbers[1] - numbers[0];
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (numbers[i] - numbers[i - 1] != step || step == 0)
      throw InputError("the numbers of " + shown(pattern) + " go from " + body.digits[i - 1] +
                       " to " + body.digits[i] + "; they must go on as they begin");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::string digits = std::to_string(numbers[i]);
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    if (digits != body.digits[i])
      throw InputError("the numbers of " + shown(pattern) + " are written with " +
                       std::to_string(width) + " digits, and " + body.digits[i] + " is not");
    files.push_back(fs::path(pattern.before + digits + pattern.after).filename().string());
  }
  const std::string number = width == 0 ? "%d" : "%0" + std::to_string(width) + "d";
  Json out = {{"frames", pattern.before + number + pattern.after}};
  if (numbers[0] != 0) out["first"] = numbers[0];
  if (step != 1) out["step"] = step;
  return out;
}

std::string without_separators(std::string stem) {
  while (!stem.empty() && (stem.back() == '_' || stem.back() == '-' || stem.back() == '.'))
    stem.pop_back();
  return stem;
}

// Files with one name in several folders are told apart by these; "frame" tells nothing.
std::string name_for(const BodyFiles& body, const std::vector<BodyFiles>& all, const Json& bodies) {
  const auto same_stem = [&](const BodyFiles& other) { return other.stem == body.stem; };
  const bool alone = body.stem != "frame" && std::count_if(all.begin(), all.end(), same_stem) == 1;
  std::string stem = alone || body.folder.empty() ? body.stem : body.folder;
  if (!name_fault(stem).empty()) stem = "body";
  const auto taken = [&](const std::string& name) {
    return std::any_of(bodies.begin(), bodies.end(),
                       [&](const Json& other) { return other.at("name") == name; });
  };
  std::string name = stem;
  for (std::size_t i = 2; taken(name); ++i) name = stem + "-" + std::to_string(i);
  return name;
}

std::vector<BodyFiles> grouped(const std::vector<fs::path>& files) {
  std::map<std::pair<std::string, std::string>, std::size_t> alike;
  for (const fs::path& file : files)
    for (const Numbered& numbered : numbers_in(file)) ++alike[numbered.key()];
  std::vector<BodyFiles> bodies;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (const fs::path& file : files) {
    if (is_cache(file)) {
      if (bodies.empty() || bodies.back().pattern || !bodies.back().cache.empty())
        throw InputError(text::in_quotes(file.string()) +
                         " is a point cache; the mesh that it moves is named before it");
      bodies.back().cache = file;
      continue;
    }
    const std::string folder = file.parent_path().filename().string();
    // The number that most other files differ in; of equals the last.
    std::optional<Numbered> best;
    for (const Numbered& numbered : numbers_in(file))
      if (alike[numbered.key()] > 1 && (!best || alike[numbered.key()] >= alike[best->key()]))
        best = numbered;
    if (!best) {
      bodies.push_back(
          {without_separators(file.stem().string()), folder, std::nullopt, {}, file, {}});
      continue;
    }
    const auto [at, is_new] = known.try_emplace(best->key(), bodies.size());
    if (is_new)
      bodies.push_back({without_separators(fs::path(best->before).filename().string()),
                        folder,
                        best,
                        {},
                        {},
                        {}});
    bodies[at->second].digits.push_back(best->digits);
  }
  return bodies;
}

}  // namespace

FrameFiles frame_files(const std::vector<fs::path>& files, const std::string& id,
                       const std::vector<Level>& levels) {
  FrameFiles out;
  Json bodies = Json::array(), level_names = Json::array();
  bool recorded = false;
  std::optional<std::size_t> frames;  // of the shortest numbered body
  std::vector<BodyFiles> groups = grouped(files);
  for (BodyFiles& body : groups) {
    Json json = {{"name", name_for(body, groups, bodies)}};
    if (!body.mesh.empty()) json["mesh"] = {{"file", body.mesh.string()}};
    if (!body.cache.empty()) json["recording"] = {{"cache", body.cache.string()}};
    if (body.pattern) {
      std::vector<std::string> names;
      json["recording"] = recording_of(body, names);
      frames = std::min(frames.value_or(names.size()), names.size());
      if (out.labels.empty()) out.labels = std::move(names);
    }
    recorded = recorded || json.contains("recording");
    out.shown.push_back(shown_files(body));
    bodies.push_back(std::move(json));
  }
  for (const Level level : levels) level_names.push_back(name_of(level));
  Json scene = {{"id", id}, {"time_step", 1}, {"levels", level_names}, {"bodies", bodies}};
  if (frames) scene["frames"] = *frames;
  if (!recorded) scene["frames"] = 1;
  out.scene = {scene.dump(), "frames to be checked", fs::current_path()};
  return out;
}

}  // namespace contactcheck::scene
