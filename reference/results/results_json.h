// results.json <-> Results: the only reader and the only writer.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reference/results/results.h"

namespace contactcheck::results {

/// What is missing stays at its default: the schema (results_file.h) says what must be there.
/// @throws nlohmann::json::exception when a field is of another type, or names an unknown value
Results from_json(const nlohmann::ordered_json& json);

/// With the fields in the order of the file.
nlohmann::ordered_json to_json(const Results& results);
nlohmann::ordered_json to_json(const Semantics& semantics);
nlohmann::ordered_json to_json(const Machine& machine);
nlohmann::ordered_json to_json(const Scene& scene);
nlohmann::ordered_json to_json(const ClosedLoop& loop);
nlohmann::ordered_json to_json(const ScaleRange& range);

}  // namespace contactcheck::results
