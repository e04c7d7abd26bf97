// The findings about the paper's own numbers, for the reproduction report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reference/report/tables/table.h"
#include "reference/reproduce/paper_arithmetic.h"

namespace contactcheck::reproduce {

/// A Markdown section (heading of level 2): the source, the sentences that contradict a claim or
/// cannot be, those that agree, claims that no table lets one check, and every figure in a table.
std::string paper_markdown(const PaperTables& tables, const std::vector<PaperFinding>& findings);

/// {"source": {...}, "findings": [{"topic", "table", "scene", "method", "sentence", "claimed",
/// "computed", "unit", "agrees"}]}; table, scene, method, claimed and agrees are null where there
/// is none; numbers are not rounded.
nlohmann::ordered_json paper_json(const PaperTables& tables,
                                  const std::vector<PaperFinding>& findings);

/// From paper_json: the source, the number of checks and of contradictions; and every figure, with
/// its finding's sentence in the last cell.
/// @throws nlohmann::json::exception for another document
std::string own_numbers(const nlohmann::ordered_json& paper);
report::TitledTable checks_table(const nlohmann::ordered_json& paper);

}  // namespace contactcheck::reproduce
