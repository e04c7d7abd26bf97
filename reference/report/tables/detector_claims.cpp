#include <set>
#include <string>

#include "reference/report/tables/run_row.h"
#include "reference/report/tables/section.h"

namespace contactcheck::report {
namespace {

Blocks detectors_blocks(const results::Index& index) {
  TitledTable table{"",
                    "A level that is not claimed is not judged.",
                    {{"detector", true}, {"options", true}, {"claims", true}},
                    {}};
  std::set<std::string> seen;
  for (const results::Run& run : index.results().runs)
    if (run.ok() && !run.semantics.levels.empty() && seen.insert(run.detector).second)
      table.rows.push_back(
          {run.detector, options_text(run.options), semantics_text(run.semantics)});
  return {std::move(table)};
}

}  // namespace

/// Options and claims of each detector, by its first row that is `ok`.
extern const Section kDetectors = {"detectors", "What each detector claims", "Detectors",
                                   detectors_blocks};

}  // namespace contactcheck::report
