// Converts results.json to and from Results: the only reader and the only writer.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reference/results/results.h"

namespace contactcheck::results {

/// Missing fields keep their defaults: the schema (results_file.h) says which are required.
/// @throws nlohmann::json::exception if a field has another type, or names an unknown value
Results from_json(const nlohmann::ordered_json& json);

/// The fields are in the order of the file.
nlohmann::ordered_json to_json(const Results& results);
nlohmann::ordered_json to_json(const Semantics& semantics);
nlohmann::ordered_json to_json(const Machine& machine);
nlohmann::ordered_json to_json(const Scene& scene);
nlohmann::ordered_json to_json(const ClosedLoop& loop);
nlohmann::ordered_json to_json(const ScaleRange& range);

}  // namespace contactcheck::results
