// The public API of the judging part for installed programs: the command line with detectors of
// their own, the other libraries' detectors, the oracle, the comparison of an answer with the
// ground truth, and results.json. Other headers of reference are not installed.
#pragma once

#include "core/core.h"
#include "reference/adapters/register.h"
#include "reference/cli/program.h"
#include "reference/judge/judge.h"
#include "reference/mesh/mesh_file.h"
#include "reference/oracle/oracle.h"
#include "reference/results/results_file.h"

namespace contactcheck {

using adapters::standard_catalog;
using cli::contactcheck_main;

}  // namespace contactcheck
