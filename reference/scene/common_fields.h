// What scene files and families of cases have in common.
#pragma once

#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/semantics.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

/// An array of names of levels, at least one, all different. @throws InputError
std::vector<Level> parse_levels(const text::JsonField& field);

/// What there is to say of a shape whose mesh had `notes`: vertices dropped, and defects.
std::string shape_notes(const BodyShape& shape, std::string notes = "");

/// A name that no body has yet. @throws InputError
std::string parse_body_name(const text::JsonField& field, const std::vector<Body>& bodies);

}  // namespace contactcheck::scene
