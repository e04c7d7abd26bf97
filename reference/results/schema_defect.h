// Where a JSON document breaks its schema, as one sentence for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace contactcheck::results {

/// "runs[2].levels.body.truth is -1; it must be at least 0", or "" when there is nothing to say.
/// Knows the keywords of JSON Schema that fixtures/results.schema.json uses.
/// @throws std::invalid_argument when the schema has another one
std::string schema_defect(const nlohmann::ordered_json& schema,
                          const nlohmann::ordered_json& document);

}  // namespace contactcheck::results
