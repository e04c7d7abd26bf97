// Known wrong answers of libraries, compared with those that a run shows.
#pragma once

#include <string>
#include <vector>

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// "Of 12 listed wrong answers of libraries that this run could show, 9 show as listed, 1 with
/// another count and 2 do not. 4 show that are not listed." The readings of the paper have a
/// sentence of their own.
std::string known_defects_sentence(const results::DefectCounts& known);

/// What is listed of libraries and of readings; what shows with another count, what is listed and
/// does not show, what shows and is not listed; without those that have no rows.
std::vector<TitledTable> known_defects_tables(const results::DefectCounts& known);

/// Of the field `known_defects` of results.json: that sentence and those tables. Empty where
/// results have no such field.
std::string known_defects_markdown(const results::Results& results);

/// The same field's value in plain lines, for a terminal: all of it, or only what differs.
std::string defects_text(const results::DefectCounts& known);
std::string defects_summary(const results::DefectCounts& known);

}  // namespace contactcheck::report
