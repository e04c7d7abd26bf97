// Families of hard cases (fixtures/README.md, "Families of hard cases"): one file gives bodies
// whose positions depend on a parameter, and the parameter's values. A family is read as a scene
// with one recorded frame per value.
#pragma once

#include <filesystem>

#include "reference/scene/scene.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

/// @throws InputError, one sentence: file, path of the field, value, what is allowed
Scene parse_family(const text::JsonField& root, const std::filesystem::path& folder);

}  // namespace contactcheck::scene
