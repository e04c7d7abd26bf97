// What two results are compared by: the rows of one results.json as plain data.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reference/statistics/statistics.h"

namespace contactcheck {

/// Sums over frames at one level.
struct LevelRow {
  std::uint64_t truth = 0, missed = 0, spurious = 0;
  bool informative = false;
  bool operator==(const LevelRow&) const = default;
};

/// Milliseconds per frame.
struct TimeRow {
  std::string question;
  std::optional<double> cold, hot;
};

/// One detector on one scene. Of a row that is not `ok` there are only names, status and message.
struct ResultRow {
  std::string scene, detector, status, message;
  std::map<std::string, LevelRow> levels;  ///< "triangle"; against rounded truth "triangle rounded"
  std::map<std::string, std::optional<double>> geometry;  ///< errors, by their key in results.json
  std::string contact_hash;
  std::vector<TimeRow> times;  ///< its own question first; empty without timing
  /// time(reference) / time(detector), cold, in the question that the two are compared in.
  std::vector<std::pair<std::string, Ratio>> speedups;
};

struct ResultTable {
  std::string version;
  std::vector<std::pair<std::string, std::string>> machine;  ///< what times depend on
  std::map<std::string, std::string> truth_hashes;           ///< by scene
  std::vector<ResultRow> rows;                               ///< as in the file

  /// Null when there is none.
  const ResultRow* find(const std::string& scene, const std::string& detector) const;
  bool has_scene(const std::string& scene) const;
};

/// @throws nlohmann::json::exception when results are not as the schema says
ResultTable read_table(const nlohmann::ordered_json& results);

}  // namespace contactcheck
