// A results.json of an earlier run, or of another program.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "reference/results/results.h"

namespace contactcheck::results {

/// Copying and writing JSON recurse, and too deep a document would overflow the stack. `json`:
/// bytes that were parsed. @throws InputError when they are nested deeper than results can be
void check_json_depth(std::string_view json, const std::filesystem::path& file);

/// @throws InputError when the file cannot be read, is no JSON, of another schema, or not as
/// fixtures/results.schema.json says, or has times that cannot be: with the first such place
results::Results results_in(const std::filesystem::path& file);

}  // namespace contactcheck::results
