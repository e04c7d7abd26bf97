// Semantics -> JSON, by the keys of results.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/types/semantics.h"

namespace contactcheck {

/// What a detector claims; `local_origin` stands there only where it is claimed.
nlohmann::ordered_json to_json(const Semantics& semantics);

}  // namespace contactcheck
