// What the HTML page is given: results.json, and what is computed of it. The page draws and lets
// people choose; sums and sentences are made here, for every choice that it offers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reference/results/results.h"

namespace contactcheck {

/// results.json with "reproduction" (reproduction.json, or null) and
/// "report":
///
///   {"title", "findings": [{"topic", "sentence"}],
///    "fastest": [detector]          without error and fastest in some scene
///    "summary": TABLE, "claims": [TABLE], "goals": TABLE,
///    "known_defects": {"sentence", "tables": [TABLE]}      where results have such
///    "pairs": [{"scene", "sentence", "table": TABLE}]
///    "levels": [level]              that some detector claims and was judged at
///    "sums": {level: [SUM]}         per detector, over all scenes but families; level "finest":
///                                   each at its finest
///    "speed_error": {"detectors": [name], "scenes": [words], "first": place in scenes,
///      "charts": [{level: CHARTS}]}}                         per choice of scenes
///
///   TABLE   {"title", "text", "columns": [{"title", "left"}], "rows": [[cell]]}, with "id" where
///           something leads to it; `code` stands in backticks
///   SUM     {"truth", "reported", "hit", "missed", "spurious"}; null; or why there is none
///   CHARTS  {"counts": [{"question", "level", "truth", "reported", "missed", "spurious"} or null],
///           per detector; "worse cold", "worse hot", "missed cold", ...:
///           {"points": [[place in detectors, ms, error, is on the front]], "left_out": sentence}}
nlohmann::ordered_json page_data(const results::Results& results,
                                 const nlohmann::ordered_json& reproduction);

}  // namespace contactcheck
