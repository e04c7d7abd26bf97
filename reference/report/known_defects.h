// Known wrong answers of libraries, compared with those that a run shows.
#pragma once

#include <string>
#include <vector>

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// "Of 12 listed wrong answers that this run could show, 10 show and 2 do not; 0 show that are not
/// listed."
std::string known_defects_sentence(const results::DefectCounts& known);

/// What is listed, what is listed and does not show, what shows and is not listed; without those
/// that have no rows.
std::vector<TitledTable> known_defects_tables(const results::DefectCounts& known);

/// Of the field `known_defects` of results.json: what is listed and shows, what is listed and does
/// not, what shows and is not listed. Empty where results have no such field.
std::string known_defects_markdown(const results::Results& results);

/// The same field's value in plain lines, for a terminal: all of it, or only what differs.
std::string defects_text(const results::DefectCounts& known);
std::string defects_summary(const results::DefectCounts& known);

}  // namespace contactcheck::report
