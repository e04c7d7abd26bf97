// What a suite hoped to measure, beside what it measured.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "reference/scene/suite_file.h"

namespace contactcheck {

/// One entry per goal: its fields, `measured` (null where it could not be, with the reason in
/// `why`), `low` and `high` where the measurement has an interval, `unit` ("x" or "us") and `met`.
/// `results` holds the runs of results.json.
nlohmann::ordered_json measure_goals(const std::vector<SuiteGoal>& goals,
                                     const nlohmann::ordered_json& results);

/// The goal itself, nothing measured; and back. @throws nlohmann::json::exception when a field is
/// missing
nlohmann::ordered_json to_json(const SuiteGoal& goal);
SuiteGoal goal_from(const nlohmann::ordered_json& json);

}  // namespace contactcheck
