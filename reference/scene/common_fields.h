// Fields that scene files and files of case families share.
#pragma once

#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/semantics.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

/// An array of names of levels, at least one, all different. @throws InputError
std::vector<Level> parse_levels(const text::JsonField& field);

/// The notes of a shape: `notes` of its mesh, vertices dropped, defects.
std::string shape_notes(const BodyShape& shape, std::string notes = "");

/// A body name that is not yet in `bodies`. @throws InputError
std::string parse_body_name(const text::JsonField& field, const std::vector<Body>& bodies);

}  // namespace contactcheck::scene
