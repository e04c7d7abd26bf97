// What the HTML page is given: results.json, and what is computed of it. The page draws and lets
// people choose; sums and sentences are made here, for every choice that it offers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reference/results/results.h"

namespace contactcheck {

/// results.json with "reproduction" (`reproduction`: the text of reproduction.json, or empty) and
/// "report":
///
///   {"title", "findings": [{"topic", "sentence"}],
///    "fastest": [detector]                  without error and fastest in some scene
///    "known_defects": sentence              where results have such
///    "claims": [{"title", "text", "columns", "rows"}]   `code` stands in backticks
///    "summary": {"columns": [{"title", "left"}], "rows": [[cell]]}
///    "levels": [level]                      that some detector claims and was judged at
///    "sums": {level: [sum]}                 per detector, over all scenes but families: {"truth",
///                                           "reported", "hit", "missed", "spurious"}, null, or why
///                                           there is none; level "finest": each at its finest
///    "speed_error": {"detectors": [name], "scenes": [words], "first": place in scenes,
///      "charts": [{level: {                 per choice of scenes; only what was judged there
///        "counts": [{"level", "truth", "reported", "missed", "spurious"} or null]   per detector
///        "worse cold", "worse hot", "missed cold", ...:
///          {"points": [[place in detectors, ms, error, is on the front]], "left_out":
///          sentence}}}]}}
nlohmann::ordered_json page_data(const results::Results& results, const std::string& reproduction);

}  // namespace contactcheck
