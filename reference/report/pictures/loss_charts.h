// Errors by detector and by stage, as pictures for Markdown: the HTML report has the same with
// tables.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// Where the report expects them, beside report.md. No picture of a family has such a name.
inline constexpr const char* kErrorsFile = "plots/who_errs.svg";
inline constexpr const char* kStagesFile = "plots/stage_losses.svg";

/// An SVG document: for every detector that errs, which share of the true contacts it missed and
/// which share of its reports is spurious, at the finest level that it claims (a row per level
/// where scenes differ in that), summed over all scenes; over the families of hard cases where
/// there is nothing else. Empty without errors.
std::string errors_picture(const results::Results& results);

/// An SVG document: for every detector whose stages lost true pairs of triangles, how many in which
/// stage, as shares of the true ones, over the same scenes. Empty where none did.
std::string stages_picture(const results::Results& results);

}  // namespace contactcheck::report
