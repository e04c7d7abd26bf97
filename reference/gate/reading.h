// The number that a rule is about, out of a row of results.
#pragma once

#include <optional>
#include <string>

#include "reference/gate/policy.h"
#include "reference/results/results.h"

namespace contactcheck::gate {

struct Reading {
  std::optional<double> value;
  std::optional<Level> level;  ///< of a measure that has levels
  std::string why_not;         ///< a sentence where there is no value
};

/// The level that a rule looks at in this row: its own, or the finest claimed and judged; none
/// when no level of the row was judged.
std::optional<Level> level_of(const Rule& rule, const results::Run& row);

/// @pre the rule's measure is an accuracy number; the row's status is `ok`
Reading read_measure(const Rule& rule, const results::Results& results, const results::Run& row);

/// The random pairs of a scene on which rational arithmetic contradicts the oracle.
Reading read_oracle_wrong(const results::Scene& scene);

/// "missed 3 at level triangle", "hover_gap_max 0.002 m"
std::string measured_text(const Rule& rule, const Reading& reading);

}  // namespace contactcheck::gate
