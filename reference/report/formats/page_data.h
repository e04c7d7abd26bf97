// The input of the HTML page, which only draws and lets people choose: sums, tables, sentences and
// points are computed here, for every choice that it offers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "reference/report/tables/paper_part.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// One object with the fields of the interface Page in reference/report/formats/web/src/page.ts.
/// `paper`: the tables of `reproduce`, if there are any.
nlohmann::ordered_json page_data(const results::Results& results,
                                 const std::optional<PaperPart>& paper);

}  // namespace contactcheck::report
