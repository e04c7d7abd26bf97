#include "reference/gate/blame.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "reference/gate/reading.h"
#include "reference/scene/shell_word.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

std::optional<std::size_t> largest(const Json& counts) {
  std::optional<std::size_t> at;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > (at ? counts[*at] : Json(0))) at = i;
  return at;
}

std::optional<std::size_t> smallest_share(const Json& shares) {
  std::optional<std::size_t> at;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (!shares[i].is_null() && shares[i] < (at ? shares[*at] : Json(1.0))) at = i;
  return at;
}

// What the rule counts: "missed", "spurious", or "" for any.
std::string kind_of(const Rule& rule) {
  const std::string name = rule.measure->name;
  if (name == "missed" || name == "recall" || name == "missed_length" || name == "stage_missed")
    return "missed";
  return name.rfind("spurious", 0) == 0 ? "spurious" : "";
}

std::optional<std::size_t> disagreed_frame(const Json& results, const Json& row,
                                           const std::string& level, const std::string& kind) {
  for (const Json& d : results.at("disagreements"))
    if (d.at("scene") == row.at("scene") && d.at("detector") == row.at("detector") &&
        (level.empty() || d.at("level") == level) && (kind.empty() || d.at("kind") == kind))
      return d.at("frame").get<std::size_t>();
  return std::nullopt;
}

std::optional<std::size_t> counted_frame(const Json& per_frame, const std::string& kind) {
  if (!kind.empty()) return largest(per_frame.at(kind));
  const auto missed = largest(per_frame.at("missed"));
  return missed ? missed : largest(per_frame.at("spurious"));
}

std::optional<std::size_t> frame_to_blame(const Rule& rule, const Json& results, const Json& row) {
  if (row.at("status") != "ok") {
    if (!row.contains("failed_frame")) return std::nullopt;
    return row.at("failed_frame").get<std::size_t>();
  }
  const MeasureKind kind = rule.measure->kind;
  const Json& per_frame = row.at("per_frame");
  if (rule.measure->field == std::string("covered_length_fraction") &&
      per_frame.contains("covered_length_fraction"))
    return smallest_share(per_frame.at("covered_length_fraction"));
  if (rule.rounded) return std::nullopt;  // per frame there are counts of the doubles alone
  const bool counted = kind == MeasureKind::kLevel || kind == MeasureKind::kHash ||
                       kind == MeasureKind::kStages || !kind_of(rule).empty();
  if (!counted) return std::nullopt;
  const std::string level = kind == MeasureKind::kLevel ? level_of(rule, row) : "";
  if (level.empty() || level == per_frame.value("level", ""))
    return counted_frame(per_frame, kind_of(rule));
  return disagreed_frame(results, row, level, kind_of(rule));
}

Words words_of(const Json& results) {
  return shell_words(results.at("command").get<std::string>());
}

// The file that the run's command named, or the id.
std::string target_of(const Json& results, const std::string& scene) {
  for (const std::string& word : words_of(results)) {
    const std::filesystem::path path(word);
    if (path.stem() == scene && (path.extension() == ".json" || path.extension() == ".ccr"))
      return word;
  }
  return scene;
}

// " --repeat 9", where the run's command had it.
std::string same_flag(const Json& results, const std::string& flag) {
  const Words words = words_of(results);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].rfind(flag + "=", 0) == 0) return " " + in_shell(words[i]);
    if (words[i] == flag && i + 1 < words.size()) return " " + flag + " " + in_shell(words[i + 1]);
  }
  return "";
}

// Frames of families, recordings and random pairs are what they are.
std::string frames_flag(const Json& row, const Json* scene, const std::string& target) {
  const bool fixed = scene != nullptr && (scene->contains("family") || scene->contains("pairs"));
  const bool recorded = std::filesystem::path(target).extension() == ".ccr";
  if (fixed || recorded || !row.contains("frames") || row.at("frames") == 0) return "";
  return " --frames " + row.at("frames").dump();
}

}  // namespace

std::string worst_frame(const Rule& rule, const RowIndex& results, const Json& row) {
  const auto frame = frame_to_blame(rule, results.results(), row);
  if (!frame) return "";
  const std::string out = "frame " + std::to_string(*frame);
  const Json* const scene = results.scene(row.at("scene").get<std::string>());
  if (scene == nullptr || !scene->contains("family")) return out;
  const Json& values = scene->at("family").at("values");
  return *frame < values.size() ? out + " (" + values[*frame].get<std::string>() + ")" : out;
}

std::string rerun_command(const Rule& rule, const RowIndex& results, const Json& row) {
  const auto id = row.at("scene").get<std::string>();
  const Json* const scene = results.scene(id);
  const std::string detector = " --detector " + in_shell(row.at("detector").get<std::string>());
  if (scene != nullptr && scene->contains("pairs"))
    return pairs_command(*scene) + detector + " --no-timing";
  const std::string target = target_of(results.results(), id);
  const std::string command =
      "contactcheck run " + in_shell(target) + frames_flag(row, scene, target) + detector;
  if (!is_timing(*rule.measure)) return command + " --no-timing";
  return command + " --detector " + in_shell(rule.reference) +
         same_flag(results.results(), "--repeat") + same_flag(results.results(), "--processes");
}

std::string pairs_command(const Json& scene) {
  const Json& pairs = scene.at("pairs");
  return "contactcheck run --pairs " + pairs.at("count").dump() + " --seed " +
         pairs.at("seed").dump();
}

}  // namespace contactcheck
