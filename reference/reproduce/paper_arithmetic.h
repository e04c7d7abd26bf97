// Arithmetic on the paper's own numbers, and where they contradict each other. Nothing is measured
// here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/reproduce/paper_tables.h"

namespace contactcheck::reproduce {

/// One figure. Every member has an initialiser, so that a finding names only what it sets.
struct PaperFinding {
  std::string topic = {};               ///< what is computed: "test-ratio"
  std::string table = {};               ///< "Table 3"
  std::string scene = {}, method = {};  ///< empty where the finding is over all
  std::string sentence = {};            ///< with the numbers, for a report
  std::optional<double> claimed = {};   ///< what the paper says, where it gives a number
  double computed = 0.0;                ///< in `unit`
  std::string unit = {};                ///< ratio, ms, %, fps or count
  std::optional<bool> agrees = {};      ///< false: contradicts a claim or cannot be; none: no claim
};

/// Every check, in a fixed order. @pre tables as load_paper_tables gives them
std::vector<PaperFinding> check_paper(const PaperTables& tables);

/// Checks the times: ratios, sums against totals, gains. Part of check_paper.
void check_times(const PaperTables& tables, std::vector<PaperFinding>& findings);
/// Checks the text against the tables. Part of check_paper.
void check_claims(const PaperTables& tables, std::vector<PaperFinding>& findings);

/// `value` as sentences show it: 3 decimals for ratio and ms, 2 for fps, 1 for %, 0 for count.
std::string paper_figure(double value, const std::string& unit);

}  // namespace contactcheck::reproduce
