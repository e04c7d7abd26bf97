#include "reference/report/csv.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/types/semantics.h"
#include "reference/report/run_row.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

struct CsvColumn {
  std::string title;
  std::function<Json(const Json& run)> value;
};

// Null where any step of the way is missing: rows that are not `ok` have next to nothing.
Json at_path(const Json& run, const std::vector<std::string>& path) {
  const Json* place = &run;
  for (const std::string& step : path) {
    if (!place->is_object() || !place->contains(step)) return nullptr;
    place = &place->at(step);
  }
  return *place;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  return quoted(value.is_string() ? value.get<std::string>() : value.dump());
}

class Columns {
 public:
  explicit Columns(const Json& results) {
    add_identity();
    add_levels();
    add_geometry();
    add_times();
    for (const std::string& reference : references_of(results)) add_speedup(reference);
    add("memory_bytes", {"memory_bytes"});
    add("contact_hash", {"contact_hash"});
    add("recording", {"recording"});
  }

  const std::vector<CsvColumn>& all() const { return columns_; }

 private:
  void add(const std::string& title, std::vector<std::string> path) {
    columns_.push_back(
        {title, [path = std::move(path)](const Json& r) { return at_path(r, path); }});
  }

  void add_identity() {
    for (const char* key : {"scene", "detector", "status", "message"}) add(key, {key});
    columns_.push_back({"options", [](const Json& run) -> Json {
                          const Json options = at_or_null(run, "options");
                          if (options.is_null() || options.empty()) return nullptr;
                          return options_text(options);
                        }});
    for (const char* key : {"frames", "contact_frames"}) add(key, {key});
    add("finest_level", {"per_frame", "level"});
  }

  void add_levels() {
    for (const std::string& level : level_names())
      for (const std::string count :
           {"truth", "reported", "hit", "missed", "spurious", "recall", "spurious_rate"})
        add(level + "_" + count, {"levels", level, count});
  }

  // Title with the unit, key of `geometry`.
  void add_geometry() {
    using Named = std::pair<const char*, const char*>;
    for (const auto& [title, key] :
         std::initializer_list<Named>{{"missed_length_m", "missed_length"},
                                      {"covered_length_fraction", "covered_length_fraction"},
                                      {"spurious_distance_max_m", "spurious_distance_max"},
                                      {"depth_error_max_m", "depth_error_max"},
                                      {"depth_error_p95_m", "depth_error_p95"},
                                      {"depth_error_mean_m", "depth_error_mean"},
                                      {"normal_error_max_deg", "normal_error_deg_max"},
                                      {"normal_error_p95_deg", "normal_error_deg_p95"},
                                      {"normal_error_mean_deg", "normal_error_deg_mean"},
                                      {"hover_gap_max_m", "hover_gap_max"},
                                      {"late_frames", "late_frames"}})
      add(title, {"geometry", key});
  }

  void add_times() {
    for (const char* key : {"question", "timed_frames", "repeats"}) add(key, {"time_ms", key});
    add("prepare_ms", {"time_ms", "prepare"});
    for (const std::string part : {"cold", "hot"})
      for (const std::string phase :
           {"map", "update", "query", "frame", "contact_frame", "self_reported"})
        add(part + "_" + phase + "_ms", {"time_ms", part, phase});
    columns_.push_back({"speedup_question", [](const Json& run) -> Json {
                          if (!run.contains("speedup")) return nullptr;
                          return compared_question(run);
                        }});
  }

  void add_speedup(const std::string& reference) {
    for (const char* part : {"cold", "hot"})
      for (const char* key : {"ratio", "low", "high"})
        columns_.push_back(
            {"vs_" + reference + "_" + part + "_" + key, [=](const Json& run) {
               if (!run.contains("speedup")) return Json(nullptr);
               return at_path(speedup_of(run, compared_question(run), reference), {part, key});
             }});
  }

  // In the order of their first speed-up.
  static std::vector<std::string> references_of(const Json& results) {
    std::vector<std::string> names;
    for (const Json& run : results.at("runs"))
      for (const Json& by_reference : at_or_null(run, "speedup"))
        for (const auto& [name, speedup] : by_reference.items())
          if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    return names;
  }

  std::vector<CsvColumn> columns_;
};

}  // namespace

std::string csv_report(const Json& results) {
  const Columns columns(results);
  std::string text;
  const auto end_line = [&] { text.replace(text.size() - 1, 1, "\r\n"); };
  for (const CsvColumn& column : columns.all()) text += quoted(column.title) + ",";
  end_line();
  for (const Json& run : results.at("runs")) {
    for (const CsvColumn& column : columns.all()) text += cell(column.value(run)) + ",";
    end_line();
  }
  return text;
}

}  // namespace contactcheck
