// Known wrong answers of libraries, compared with those that a run shows.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// "Of 12 listed wrong answers of libraries that this run could show, 9 show as listed, 1 with
/// another count and 2 do not. 4 show that are not listed." The readings of the paper have a
/// sentence of their own.
std::string known_defects_sentence(const results::DefectCounts& known);

/// The field `known_defects` of results.json in plain lines, for a terminal: all of it, or only
/// what differs.
std::string defects_text(const results::DefectCounts& known);
std::string defects_summary(const results::DefectCounts& known);

}  // namespace contactcheck::report
