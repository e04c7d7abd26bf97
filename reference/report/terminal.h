#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// The result tables of all scenes as aligned plain text, with a legend. `color` adds ANSI colours
/// to misses, spurious contacts and errors.
std::string terminal_tables(const nlohmann::ordered_json& results, bool color);

}  // namespace contactcheck
