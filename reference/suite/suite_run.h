// Runs scenes one after the other, each in worker processes, and puts results.json together.
#pragma once

#include "reference/results/results.h"
#include "reference/suite/suite_request.h"

namespace contactcheck::suite {

/// Writes out/results.json, out/recordings/, out/contacts/ and out/cases/, and until results.json
/// is complete out/partial/. Returns the results as written.
/// @throws InputError for bad scenes, an unwritable folder, or scenes that an interrupted run has
/// finished there and that would be lost (SuiteRequest::overwrite)
results::Results run_suite(const SuiteRequest& request, const SuiteListener& listener,
                           SuiteOutcome* outcome);

}  // namespace contactcheck::suite
