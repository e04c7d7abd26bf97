// What `run` and `reproduce` share: run the scenes, write results.json and its reports.
#pragma once

#include <string>

#include "core/detect/registry.h"
#include "reference/cli/commands.h"
#include "reference/suite/out_lock.h"
#include "reference/suite/suite_run.h"

namespace contactcheck::cli {

struct ReportedRun {
  results::Results results;  ///< as written
  std::string reports;       ///< their paths, for a person
  suite::OutLock lock;       ///< of --out
};

/// @throws InputError, before anything is written, for bad arguments
ReportedRun run_and_report(const RunArguments& arguments, const DetectorCatalog& catalog,
                           suite::SuiteOutcome* outcome);

/// Reduces the first case of every detector, level and kind of a run, and the first error of every
/// detector. Writes OUT/cases/min-DETECTOR-KIND-LEVEL-SCENE.json; prints a line each, to standard
/// error where standard output has events.
void reduce_first_errors(const results::Results& results, const RunArguments& run,
                         const DetectorCatalog& catalog);

/// Also says on standard error if the oracle is wrong.
int exit_code_of(const suite::SuiteOutcome& outcome);

}  // namespace contactcheck::cli
