// What a detector found and what it should have found, summed over runs.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace contactcheck {

struct ErrorCounts {
  std::int64_t truth = 0, reported = 0, missed = 0, spurious = 0;

  /// Adds those of a run that is `ok`, at this level. False where that was not judged or is no
  /// claim of its detector.
  /// @throws nlohmann::json::exception when the run is not as the schema says
  bool add(const nlohmann::ordered_json& run, const std::string& level);

  /// missed / truth; nothing where there was nothing to find.
  std::optional<double> missed_share() const;
  /// spurious / reported; nothing where nothing was reported.
  std::optional<double> spurious_share() const;
  /// The larger one; nothing where there is neither.
  std::optional<double> worse_share() const;
};

}  // namespace contactcheck
