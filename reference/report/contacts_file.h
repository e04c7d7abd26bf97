// contacts/SCENE.json: which pairs touch, and which are missed or spurious, for the 3D view.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/deform/recording.h"

namespace contactcheck::report {

/// The document as it is, checked against the recording that its numbers speak of: a page may
/// follow every one of them. `name` is the file in messages.
/// @throws InputError: no JSON, of another schema or scene, or it names a frame, body, triangle,
/// cell or vertex that the recording does not have
nlohmann::ordered_json read_contacts(const std::string& text, const std::string& name,
                                     const Recording& recording);

}  // namespace contactcheck::report
