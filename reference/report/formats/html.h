// The HTML report: one self-contained page that draws results.json, and the scenes in 3D.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "reference/report/tables/paper_part.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// True if this build contains the page; making it needs npm.
bool has_html_report();

/// The same page with other data: JSON for main.ts, and the bytes of its 3D view or none.
/// @pre has_html_report()
std::string html_page(const std::string& data, std::string_view view);

/// `paper`: the page's part about a reproduction of the same run, if there is one. `view`: the
/// bytes of view_bytes.h, or empty for a report without 3D view.
/// @pre has_html_report()
std::string html_report(const results::Results& results, const std::optional<PaperPart>& paper,
                        std::string_view view);

}  // namespace contactcheck::report
