// The rows of results.json by scene and detector.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>

namespace contactcheck {

/// Refers to the results, which must outlive it. @throws nlohmann::json::exception when they do not
/// have the schema's fields
class RowIndex {
 public:
  explicit RowIndex(const nlohmann::ordered_json& results);

  const nlohmann::ordered_json& results() const { return *results_; }
  /// Null when there is none.
  const nlohmann::ordered_json* row(const std::string& scene, const std::string& detector) const;
  const nlohmann::ordered_json* scene(const std::string& id) const;
  /// Does any row or the list of scenes name it?
  bool has_scene(const std::string& id) const;

 private:
  const nlohmann::ordered_json* results_;
  std::map<std::pair<std::string, std::string>, const nlohmann::ordered_json*> rows_;
  std::map<std::string, const nlohmann::ordered_json*> scenes_;  ///< null: no entry of its own
};

/// @throws nlohmann::json::exception when there is no such text
std::string text_at(const nlohmann::ordered_json& object, const char* key);

}  // namespace contactcheck
