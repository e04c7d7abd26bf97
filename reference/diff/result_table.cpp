#include "reference/diff/result_table.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kErrors[] = {"missed_length",
                                   "covered_length_fraction",
                                   "spurious_distance_max",
                                   "depth_error_max",
                                   "depth_error_mean",
                                   "depth_error_p95",
                                   "normal_error_deg_max",
                                   "normal_error_deg_mean",
                                   "normal_error_deg_p95",
                                   "hover_gap_max",
                                   "late_frames"};

// In the order of preference: what most detectors can be asked.
constexpr const char* kQuestions[] = {"triangles", "body", "contacts", "cells"};

std::optional<double> number(const Json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || it->is_null()) return std::nullopt;
  return it->get<double>();
}

void add_levels(const Json& levels, const std::string& suffix, ResultRow& row) {
  for (const auto& [name, counts] : levels.items()) {
    LevelRow& level = row.levels[name + suffix];
    counts.at("truth").get_to(level.truth);
    counts.at("missed").get_to(level.missed);
    counts.at("spurious").get_to(level.spurious);
    level.informative = counts.value("informative", false);
  }
}

TimeRow time_row(const Json& times) {
  return {times.at("question").get<std::string>(), number(times.at("cold"), "frame"),
          number(times.at("hot"), "frame")};
}

void add_times(const Json& run, ResultRow& row) {
  const Json& times = run.at("time_ms");
  if (!times.contains("cold")) return;  // a run without timing
  row.times.push_back(time_row(times));
  for (const Json& other : run.value("time_ms_other_questions", Json::array()))
    row.times.push_back(time_row(other));
}

void add_speedups(const Json& run, ResultRow& row) {
  const auto speedup = run.find("speedup");
  if (speedup == run.end()) return;
  for (const char* question : kQuestions) {
    const auto references = speedup->find(question);
    if (references == speedup->end()) continue;
    for (const auto& [reference, ratios] : references->items()) {
      const Json& cold = ratios.at("cold");
      row.speedups.push_back({reference,
                              {cold.at("ratio").get<double>(), cold.at("low").get<double>(),
                               cold.at("high").get<double>()}});
    }
    return;
  }
}

ResultRow read_row(const Json& run) {
  ResultRow row;
  run.at("scene").get_to(row.scene);
  run.at("detector").get_to(row.detector);
  run.at("status").get_to(row.status);
  row.message = run.value("message", "");
  if (row.status != "ok") return row;
  add_levels(run.at("levels"), "", row);
  add_levels(run.value("levels_rounded", Json::object()), " rounded", row);
  for (const char* key : kErrors) row.geometry[key] = number(run.at("geometry"), key);
  run.at("contact_hash").get_to(row.contact_hash);
  add_times(run, row);
  add_speedups(run, row);
  return row;
}

}  // namespace

const ResultRow* ResultTable::find(const std::string& scene, const std::string& detector) const {
  const auto it = std::find_if(rows.begin(), rows.end(), [&](const ResultRow& row) {
    return row.scene == scene && row.detector == detector;
  });
  return it == rows.end() ? nullptr : &*it;
}

bool ResultTable::has_scene(const std::string& scene) const {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const ResultRow& row) { return row.scene == scene; });
}

ResultTable read_table(const Json& results) {
  ResultTable table;
  results.at("version").get_to(table.version);
  for (const char* key : {"cpu", "isa", "compiler", "build"})
    table.machine.emplace_back(key, results.at("machine").at(key).get<std::string>());
  for (const Json& scene : results.value("scenes", Json::array()))
    table.truth_hashes[scene.at("id").get<std::string>()] = scene.value("truth_hash", "");
  for (const Json& run : results.at("runs")) table.rows.push_back(read_row(run));
  return table;
}

}  // namespace contactcheck
