// Error against the parameter of a family of hard cases, as a picture.
#pragma once

#include <string>
#include <vector>

#include "reference/report/tables/family_result.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// An SVG document: a row per detector that goes wrong in the family, a column per value of its
/// parameter; of each square the upper half says which share of the true contacts was missed, the
/// lower half which share of those reported is spurious. A square is a group with data-detector and
/// data-frame. Empty when no detector goes wrong.
/// @pre `results` are the family_results of the results that `scene` is a part of
std::string stability_plot(const results::Scene& scene, const std::vector<FamilyResult>& results);

}  // namespace contactcheck::report
