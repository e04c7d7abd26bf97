// Reads a results.json of an earlier run or of another program.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "reference/results/results.h"

namespace contactcheck::results {

/// Copying and writing JSON recurse, so a deeply nested document could overflow the stack. `json`:
/// bytes that were parsed. @throws InputError if they are nested deeper than results can be
void check_json_depth(std::string_view json, const std::filesystem::path& file);

/// @throws InputError with the first wrong place, if the file cannot be read, is not JSON, has
/// another schema, violates fixtures/results.schema.json, or has impossible times
results::Results results_in(const std::filesystem::path& file);

}  // namespace contactcheck::results
