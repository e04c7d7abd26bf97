// The HTML report: one self-contained page that draws results.json, and the scenes in 3D.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "reference/report/tables/paper_part.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// Whether this build carries the page (it takes npm to make it).
bool has_html_report();

/// `paper`: what the page shows of a reproduction of the same run, where there is one. `view`: the
/// bytes of reference/report/formats/view_bytes.h, or nothing: a report without 3D view.
/// @pre has_html_report()
std::string html_report(const results::Results& results, const std::optional<PaperPart>& paper,
                        std::string_view view);

}  // namespace contactcheck::report
