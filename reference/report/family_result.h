// A detector's answers to one family of hard cases, as they stand in results.json.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace contactcheck {

/// Refers to results that must outlive it. Whatever is not as the schema says throws
/// nlohmann::json::exception.
struct FamilyResult {
  const nlohmann::ordered_json& scene;
  const nlohmann::ordered_json& run;

  std::string detector() const { return run.at("detector").get<std::string>(); }
  bool judged() const { return run.at("status") == "ok" && !level().empty(); }
  bool failed() const { return run.at("status") == "error"; }
  bool refused() const { return run.at("status") == "refused"; }
  /// The finest level judged; empty when none was.
  std::string level() const;

  std::size_t cases() const { return scene.at("family").at("values").size(); }
  /// Of the parameter, in that case.
  std::string value(std::size_t frame) const;
  /// `kind`: "truth", "missed" or "spurious". @pre judged()
  std::int64_t at(const char* kind, std::size_t frame) const;
  bool wrong_at(std::size_t frame) const { return at("missed", frame) + at("spurious", frame) > 0; }
  /// Over all cases; 0 where nothing was judged.
  std::int64_t sum(const char* kind) const;
  std::size_t wrong() const;
  /// Wrong somewhere, or without an answer because of an error.
  bool goes_wrong() const { return failed() || wrong() > 0; }
  /// The case in which it ended in an error, where that is known.
  std::optional<std::size_t> failed_frame() const;
  /// Milliseconds of a case, cold, mapping and update included; nothing where none was timed.
  std::optional<double> milliseconds() const;
};

/// In the order of scenes, then of runs.
std::vector<FamilyResult> family_results(const nlohmann::ordered_json& results);

}  // namespace contactcheck
