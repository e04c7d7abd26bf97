// The first violation of a JSON schema, as one sentence for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace contactcheck::results {

/// "runs[2].levels.body.truth is -1; it must be at least 0", or "" if the document is valid.
/// It supports the keywords of JSON Schema that fixtures/results.schema.json uses.
/// @throws std::invalid_argument if the schema has another keyword
std::string schema_defect(const nlohmann::ordered_json& schema,
                          const nlohmann::ordered_json& document);

}  // namespace contactcheck::results
