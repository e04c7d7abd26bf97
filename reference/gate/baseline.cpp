#include "reference/gate/baseline.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

Json lean(Json row) {
  if (row.contains("recording")) row["recording"] = "";
  if (row.contains("geometry"))
    for (const char* key : {"episodes", "depth_error_histogram", "normal_error_deg_histogram",
                            "spurious_distance_histogram"})
      row["geometry"].erase(key);
  if (!row.contains("per_frame")) return row;
  for (const char* key : {"covered_length_fraction", "frame_ms"})
    if (row["per_frame"].contains(key)) row["per_frame"][key] = Json::array();
  return row;
}

std::string lines_of(const Json& list) {
  std::string out;
  for (const Json& item : list) out += (out.empty() ? "\n  " : ",\n  ") + item.dump();
  return "[" + out + (out.empty() ? "]" : "\n ]");
}

// "KEY A -> B", where it changed.
void add_change(std::string& line, const std::string& key, const std::string& before,
                const std::string& now) {
  if (before != now) line += (line.empty() ? "" : ", ") + key + " " + before + " -> " + now;
}

using Count = std::uint64_t results::LevelCounts::*;

std::string count_text(const results::Run& row, Count count) {
  const auto finest =
      row.per_frame.level ? row.levels.find(*row.per_frame.level) : row.levels.end();
  return finest == row.levels.end() ? "null" : std::to_string(finest->second.*count);
}

std::string row_change(const results::Run& before, const results::Run& now) {
  std::string line;
  add_change(line, "status", name_of(before.status), name_of(now.status));
  if (!before.ok() || !now.ok()) return line;
  add_change(line, "frames", std::to_string(before.frames), std::to_string(now.frames));
  for (const auto& [name, count] :
       {std::pair<const char*, Count>{"truth", &results::LevelCounts::truth},
        {"missed", &results::LevelCounts::missed},
        {"spurious", &results::LevelCounts::spurious}})
    add_change(line, name, count_text(before, count), count_text(now, count));
  add_change(line, "contact_hash", before.contact_hash, now.contact_hash);
  return line;
}

using Texts = std::vector<std::pair<std::string, std::string>>;

std::string text_in(const Texts& texts, const std::string& key) {
  for (const auto& [name, text] : texts)
    if (name == key) return text;
  return "null";
}

void add_members(const char* kind, const Texts& before, const Texts& now,
                 std::vector<std::string>& out) {
  Texts all = before;
  for (const auto& [key, text] : now)
    if (std::none_of(before.begin(), before.end(), [&](const auto& t) { return t.first == key; }))
      all.emplace_back(key, text);
  for (const auto& [key, ignored] : all) {
    std::string line;
    add_change(line, kind + (" " + key), text_in(before, key), text_in(now, key));
    if (!line.empty()) out.push_back(line);
  }
}

}  // namespace

Json baseline_of(const Json& results) {
  Json out = results;
  out["disagreements"] = Json::array();
  for (const char* how_it_ran : {"resumed", "shard", "merged"}) out.erase(how_it_ran);
  if (out.contains("scenes"))
    for (Json& scene : out["scenes"]) scene.erase("separation");
  out["runs"] = Json::array();
  for (const Json& row : results.at("runs")) out["runs"].push_back(lean(row));
  return out;
}

std::string baseline_text(const Json& baseline) {
  std::string out;
  for (const auto& [key, value] : baseline.items()) {
    const bool listed = key == "runs" || key == "scenes";
    out += (out.empty() ? " " : ",\n ") + Json(key).dump() + ": " +
           (listed ? lines_of(value) : value.dump());
  }
  return "{\n" + out + "\n}\n";
}

std::vector<std::string> baseline_changes(const results::Results& before,
                                          const results::Results& now) {
  std::vector<std::string> out;
  add_members("machine", members_of(before.machine), members_of(now.machine), out);
  add_members("library", before.libraries, now.libraries, out);
  const auto name = [](const results::Run& row) { return row.scene + "  " + row.detector; };
  for (const results::Run& row : now.runs) {
    const results::Run* const old = before.run(row.scene, row.detector);
    const std::string change = old == nullptr ? "new" : row_change(*old, row);
    if (!change.empty()) out.push_back(name(row) + ": " + change);
  }
  for (const results::Run& old : before.runs)
    if (now.run(old.scene, old.detector) == nullptr) out.push_back(name(old) + ": gone");
  return out;
}

}  // namespace contactcheck
