// Compares known wrong answers of libraries with those that a run shows.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// "Of 12 listed wrong answers of libraries that this run could show, 9 show as listed, 1 with
/// another count and 2 do not. 4 show that are not listed." The readings of the paper have a
/// separate sentence.
std::string known_defects_sentence(const results::DefectCounts& known);

/// The field `known_defects` of results.json as plain lines for a terminal: all of it, or only the
/// differences.
std::string defects_text(const results::DefectCounts& known);
std::string defects_summary(const results::DefectCounts& known);

}  // namespace contactcheck::report
