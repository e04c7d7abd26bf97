// The HTML report: one self-contained page that draws results.json, and the scenes in 3D.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "reference/results/results.h"

namespace contactcheck {

/// Whether this build carries the page (it takes npm to make it).
bool has_html_report();

/// `reproduction`: reproduction.json, which the page shows beside the results, or null. `view`: the
/// bytes of reference/view/view_bytes.h, or nothing: a report without 3D view.
/// @pre has_html_report()
std::string html_report(const results::Results& results, const nlohmann::ordered_json& reproduction,
                        std::string_view view);

}  // namespace contactcheck
