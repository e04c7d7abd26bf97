// contacts/SCENE.json for the 3D view: true, missed and spurious pairs.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/deform/recording.h"
#include "core/types/semantics.h"

namespace contactcheck::report {

/// Reads the document and checks it against the recording that its numbers refer to, so that a page
/// can use them unchecked. `name` is the file in messages.
/// @throws InputError: not JSON, another schema or scene, or a frame, body, triangle, cell or
/// vertex that the recording does not have
nlohmann::ordered_json read_contacts(const std::string& text, const std::string& name,
                                     const Recording& recording);

/// What the numbers of a missed or spurious pair count. @throws InputError for an unknown level
NamedElements elements_at(const std::string& level, bool missed);

/// Calls `visit` with both elements of every listed pair, true pairs first.
/// @throws Json::exception or InputError if a field is missing, of another type or unknown
void visit_elements(
    const nlohmann::ordered_json& contacts,
    const std::function<void(std::int64_t body, std::int64_t element, Element kind)>& visit);

}  // namespace contactcheck::report
