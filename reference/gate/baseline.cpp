#include "reference/gate/baseline.h"

#include <nlohmann/json.hpp>

#include "reference/gate/row_index.h"

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

std::string row_name(const Json& row) {
  return row.at("scene").get<std::string>() + "  " + row.at("detector").get<std::string>();
}

// "KEY A -> B", where it changed.
void add_change(std::string& line, const std::string& key, const Json& before, const Json& now) {
  if (before == now) return;
  const auto text = [](const Json& v) { return v.is_string() ? v.get<std::string>() : v.dump(); };
  line += (line.empty() ? "" : ", ") + key + " " + text(before) + " -> " + text(now);
}

Json finest_level(const Json& row) {
  const std::string level = row.at("per_frame").value("level", "");
  return row.at("levels").value(level, Json::object());
}

std::string row_change(const Json& before, const Json& now) {
  std::string line;
  add_change(line, "status", before.at("status"), now.at("status"));
  if (before.at("status") != "ok" || now.at("status") != "ok") return line;
  add_change(line, "frames", before.at("frames"), now.at("frames"));
  const Json old = finest_level(before), level = finest_level(now);
  for (const char* key : {"truth", "missed", "spurious"})
    add_change(line, key, old.value(key, Json()), level.value(key, Json()));
  add_change(line, "contact_hash", before.at("contact_hash"), now.at("contact_hash"));
  return line;
}

void add_members(const char* kind, const Json& before, const Json& now,
                 std::vector<std::string>& out) {
  Json all = before;
  all.update(now);
  for (const auto& [key, ignored] : all.items()) {
    std::string line;
    add_change(line, kind + (" " + key), before.value(key, Json()), now.value(key, Json()));
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

std::vector<std::string> baseline_changes(const Json& before, const Json& now) {
  std::vector<std::string> out;
  add_members("machine", before.at("machine"), now.at("machine"), out);
  add_members("library", before.at("libraries"), now.at("libraries"), out);
  const RowIndex old_rows(before), rows(now);
  const auto key = [](const Json& row, const char* name) {
    return row.at(name).get<std::string>();
  };
  for (const Json& row : now.at("runs")) {
    const Json* const old = old_rows.row(key(row, "scene"), key(row, "detector"));
    const std::string change = old == nullptr ? "new" : row_change(*old, row);
    if (!change.empty()) out.push_back(row_name(row) + ": " + change);
  }
  for (const Json& old : before.at("runs"))
    if (rows.row(key(old, "scene"), key(old, "detector")) == nullptr)
      out.push_back(row_name(old) + ": gone");
  return out;
}

}  // namespace contactcheck
