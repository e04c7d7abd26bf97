// The page of the HTML report, bundled by build.mjs from this folder.
#pragma once

#include <string_view>

namespace contactcheck::report {

/// Contains the placeholders @results@ and @view@; empty in a build without npm.
extern const std::string_view kReportTemplate;

}  // namespace contactcheck::report
