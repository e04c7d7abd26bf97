#include "reference/reproduce/paper_tables.h"

#include <algorithm>

#include "core/types/check.h"
#include "reference/text/file_text.h"
#include "reference/text/id_check.h"
#include "reference/text/json_field.h"

namespace contactcheck::reproduce {
namespace {

// Far above any count or time of such a paper, and low enough that sums and products stay finite.
constexpr std::size_t kMostCounted = 1000000000;
constexpr double kLongestMs = 3.6e6;  // an hour for one step
constexpr double kLargestClaim = 1e6;
constexpr std::size_t kFirstYear = 1900, kLastYear = 2100;

std::vector<std::string> parse_authors(const text::JsonField& field) {
  std::vector<std::string> authors;
  for (const text::JsonField& item : field.items(1)) authors.push_back(item.text());
  return authors;
}

PaperSource parse_source(const text::JsonField& field) {
  field.only_keys({"authors", "title", "journal", "year", "doi"});
  PaperSource source;
  source.authors = parse_authors(field.at("authors"));
  source.title = field.at("title").text();
  source.journal = field.at("journal").text();
  source.year = field.at("year").whole(kFirstYear, kLastYear);
  source.doi = field.at("doi").text();
  return source;
}

PaperClaim parse_claim(const text::JsonField& field) {
  field.only_keys({"says", "value", "low", "high"});
  PaperClaim claim;
  claim.says = field.at("says").text();
  claim.low = field.at("low").number({.low = 0.0, .high = kLargestClaim});
  claim.high = field.at("high").number({.low = claim.low, .high = kLargestClaim});
  if (field.has("value"))
    claim.value = field.at("value").number({.low = claim.low, .high = claim.high});
  return claim;
}

std::vector<PaperDevice> parse_devices(const text::JsonField& field) {
  std::vector<PaperDevice> devices;
  std::vector<std::string> names;
  for (const text::JsonField& item : field.items(1)) {
    item.only_keys({"name", "average_frame_rate"});
    const std::string name = item.at("name").text();
    if (std::find(names.begin(), names.end(), name) != names.end())
      item.at("name").refuse("named once only");
    names.push_back(name);
    devices.push_back({name, parse_claim(item.at("average_frame_rate"))});
  }
  return devices;
}

PaperScene parse_scene(const text::JsonField& field) {
  field.only_keys({"scene", "objects", "objects_in_text", "vertices", "triangles", "cells"});
  const auto count = [&](const char* key) { return field.at(key).whole(1, kMostCounted); };
  PaperScene scene;
  scene.id = text::parse_id(field.at("scene"));
  scene.objects = count("objects");
  if (field.has("objects_in_text")) scene.objects_in_text = count("objects_in_text");
  scene.vertices = count("vertices");
  scene.triangles = count("triangles");
  scene.cells = count("cells");
  return scene;
}

std::vector<PaperScene> parse_scenes(const text::JsonField& field) {
  std::vector<PaperScene> scenes;
  for (const text::JsonField& item : field.items(1)) {
    const PaperScene scene = parse_scene(item);
    const auto same = [&](const PaperScene& other) { return other.id == scene.id; };
    if (std::any_of(scenes.begin(), scenes.end(), same)) item.at("scene").refuse("named once only");
    scenes.push_back(scene);
  }
  return scenes;
}

std::vector<std::string> names_of(const std::vector<PaperDevice>& devices) {
  std::vector<std::string> names;
  for (const PaperDevice& device : devices) names.push_back(device.name);
  return names;
}

std::vector<std::string> ids_of(const std::vector<PaperScene>& scenes) {
  std::vector<std::string> ids;
  for (const PaperScene& scene : scenes) ids.push_back(scene.id);
  return ids;
}

PaperRow parse_row(const text::JsonField& field, const std::vector<std::string>& scenes,
                   const std::vector<std::string>& methods) {
  field.only_keys({"scene", "method", "mss", "cell", "test", "response", "total"});
  const auto time = [&](const char* key) {
    return field.at(key).number({.low = 0.0, .low_open = true, .high = kLongestMs});
  };
  PaperRow row;
  row.scene = field.at("scene").one_of(scenes);
  row.method = field.at("method").one_of(methods);
  row.mss = time("mss");
  row.cell = time("cell");
  row.test = time("test");
  row.response = time("response");
  // Other totals that are too small are findings; this one would leave nothing to divide by.
  row.total = field.at("total").number({.low = row.test, .low_open = true, .high = kLongestMs});
  return row;
}

bool has_row(const PaperTable& table, const std::string& scene, const std::string& method) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const PaperRow& row) {
    return row.scene == scene && row.method == method;
  });
}

void parse_rows(const text::JsonField& field, const std::vector<std::string>& scenes,
                PaperTable& table) {
  for (const text::JsonField& item : field.items(1)) {
    const PaperRow row = parse_row(item, scenes, {table.before, table.after});
    if (has_row(table, row.scene, row.method))
      item.fail("is a second row of " + row.method + " on " + row.scene);
    table.rows.push_back(row);
  }
  for (const std::string& scene : table.scenes())
    for (const std::string& method : {table.before, table.after})
      if (!has_row(table, scene, method)) field.fail("has no row of " + method + " on " + scene);
}

PaperTable parse_table(const text::JsonField& field, const std::string& name,
                       const std::vector<PaperDevice>& devices,
                       const std::vector<PaperScene>& scenes) {
  field.only_keys({"device", "before", "after", "rows"});
  PaperTable table;
  table.name = name;
  table.device = field.at("device").one_of(names_of(devices));
  table.before = text::parse_id(field.at("before"));
  table.after = text::parse_id(field.at("after"));
  if (table.after == table.before) field.at("after").refuse("another method than before");
  parse_rows(field.at("rows"), ids_of(scenes), table);
  return table;
}

PaperClaims parse_claims(const text::JsonField& field, const PaperTables& tables) {
  field.only_keys({"frame_rate_gain", "best_frame_rate", "best_device", "best_scene", "test_share",
                   "cell_share", "one_level_gain"});
  PaperClaims claims;
  claims.frame_rate_gain = parse_claim(field.at("frame_rate_gain"));
  claims.best_frame_rate = parse_claim(field.at("best_frame_rate"));
  claims.best_device = field.at("best_device").one_of(names_of(tables.devices));
  claims.best_scene = field.at("best_scene").one_of(ids_of(tables.scenes));
  claims.test_share = parse_claim(field.at("test_share"));
  claims.cell_share = parse_claim(field.at("cell_share"));
  claims.one_level_gain = parse_claim(field.at("one_level_gain"));
  return claims;
}

}  // namespace

std::vector<std::string> PaperTable::scenes() const {
  std::vector<std::string> out;
  for (const PaperRow& row : rows)
    if (std::find(out.begin(), out.end(), row.scene) == out.end()) out.push_back(row.scene);
  return out;
}

const PaperRow& PaperTable::row(const std::string& scene, const std::string& method) const {
  const auto it = std::find_if(rows.begin(), rows.end(), [&](const PaperRow& row) {
    return row.scene == scene && row.method == method;
  });
  CONTACTCHECK_INVARIANT(it != rows.end(), name + " has a row of " + method + " on " + scene);
  return *it;
}

PaperTables load_paper_tables(const std::filesystem::path& file) {
  const std::string document = "paper file " + text::in_quotes(file.string());
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, "paper file"), document);
  const text::JsonField root(value, document);
  root.only_keys({"source", "devices", "table_1", "table_2", "table_3", "claims"});
  PaperTables tables;
  tables.source = parse_source(root.at("source"));
  tables.devices = parse_devices(root.at("devices"));
  tables.scenes = parse_scenes(root.at("table_2"));
  tables.table_1 = parse_table(root.at("table_1"), "Table 1", tables.devices, tables.scenes);
  tables.table_3 = parse_table(root.at("table_3"), "Table 3", tables.devices, tables.scenes);
  tables.claims = parse_claims(root.at("claims"), tables);
  return tables;
}

}  // namespace contactcheck::reproduce
