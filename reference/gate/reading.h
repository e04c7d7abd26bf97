// The number that a rule is about, out of a row of results.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "reference/gate/policy.h"
#include "reference/gate/row_index.h"

namespace contactcheck {

struct Reading {
  std::optional<double> value;
  std::string level;    ///< of a measure that has levels
  std::string why_not;  ///< a sentence where there is no value
};

/// The level that a rule looks at in this row: its own, or the finest claimed and judged; "" when
/// no level of the row was judged.
std::string level_of(const Rule& rule, const nlohmann::ordered_json& row);

/// @pre the rule's measure is an accuracy number; the row's status is `ok`
/// @throws nlohmann::json::exception when the row does not have the schema's fields
Reading read_measure(const Rule& rule, const RowIndex& results, const nlohmann::ordered_json& row);

/// The random pairs of a scene on which rational arithmetic contradicts the oracle.
Reading read_oracle_wrong(const nlohmann::ordered_json& scene);

/// "missed 3 at level triangle", "hover_gap_max 0.002 m"
std::string measured_text(const Rule& rule, const Reading& reading);

}  // namespace contactcheck
