// Families of hard cases (fixtures/README.md, "Families of hard cases"): one file gives bodies
// whose positions depend on a parameter, and the parameter's values. A family is read as a scene
// with one recorded frame per value.
#pragma once

#include <filesystem>

#include "reference/scene/json_field.h"
#include "reference/scene/scene.h"

namespace contactcheck {

/// @throws InputError, one sentence: file, path of the field, value, what is allowed
Scene parse_family(const JsonField& root, const std::filesystem::path& folder);

}  // namespace contactcheck
