// Ids of scenes and suites: they become file names.
#pragma once

#include <string>

#include "reference/text/json_field.h"

namespace contactcheck::text {

/// An id: letters, digits, '-', '_' and '.', beginning with a letter or digit, 64 at most.
bool is_id(const std::string& text);

/// @throws InputError when the field is no id
std::string parse_id(const JsonField& field);

}  // namespace contactcheck::text
