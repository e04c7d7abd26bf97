// The levels that a scene file asks for.
#pragma once

#include <vector>

#include "core/types/semantics.h"
#include "reference/scene/json_field.h"

namespace contactcheck {

/// An array of names of levels, at least one, all different. @throws InputError
std::vector<Level> parse_levels(const JsonField& field);

}  // namespace contactcheck
