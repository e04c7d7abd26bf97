// What `run` and `reproduce` share: run the scenes, write results.json and report.md.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/detect/registry.h"
#include "reference/cli/commands.h"
#include "reference/run/suite_run.h"

namespace contactcheck {

/// The results as written. @throws InputError, before anything is written, for bad arguments
nlohmann::ordered_json run_and_report(const RunArguments& arguments, const DetectorCatalog& catalog,
                                      SuiteOutcome* outcome);

}  // namespace contactcheck
