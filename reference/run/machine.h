// Where a result was measured.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace contactcheck {

/// {"cpu", "cores", "isa", "os", "compiler", "build"}
nlohmann::ordered_json describe_machine();

}  // namespace contactcheck
