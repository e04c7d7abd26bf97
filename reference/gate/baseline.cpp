#include "reference/gate/baseline.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "reference/gate/gate.h"
#include "reference/results/results_json.h"

namespace contactcheck::gate {
namespace {
using Json = nlohmann::ordered_json;

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
  for (const std::string& lost : judged_no_more(now, before))
    line += (line.empty() ? "" : ", ") + lost;
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

results::Results baseline_of(results::Results results) {
  results.disagreements.clear();
  results.resumed.reset();
  results.identities.clear();
  results.merged.clear();
  for (results::Scene& scene : results.scenes) scene.separation.clear();
  for (results::Run& row : results.runs) {
    row.recording.clear();
    row.per_frame.covered_length_fraction.clear();
    if (row.per_frame.frame_ms) row.per_frame.frame_ms->clear();
    results::Geometry& geometry = row.geometry;
    geometry.episodes.clear();
    for (auto* histogram : {&geometry.spurious_distance_histogram, &geometry.depth.histogram,
                            &geometry.normal_deg.histogram})
      histogram->clear();
  }
  return results;
}

std::string baseline_text(const results::Results& baseline) {
  std::string out;
  Json fields = results::to_json(baseline);
  // A histogram that is there has as many errors as were judged: an empty one is left out.
  for (Json& row : fields.at("runs")) {
    if (!row.contains("geometry")) continue;
    Json kept = Json::object();
    for (const auto& [key, value] : row["geometry"].items())
      if (!value.is_array() || !value.empty()) kept[key] = value;
    row["geometry"] = std::move(kept);
  }
  for (const auto& [key, value] : fields.items()) {
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
  const results::Index rows_before(before), rows_now(now);
  for (const results::Run& row : now.runs) {
    const results::Run* const old = rows_before.run(row.scene, row.detector);
    const std::string change = old == nullptr ? "new" : row_change(*old, row);
    if (!change.empty()) out.push_back(name(row) + ": " + change);
  }
  for (const results::Run& old : before.runs)
    if (rows_now.run(old.scene, old.detector) == nullptr) out.push_back(name(old) + ": gone");
  return out;
}

}  // namespace contactcheck::gate
