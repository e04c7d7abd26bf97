// The command line as a function, so that tests can run it with detectors of their own.
#pragma once

#include "core/detect/registry.h"

namespace contactcheck::cli {

/// Does what `contactcheck ARGUMENTS...` does with the detectors of `catalog`. Workers are started
/// from the running program, so its main must only call this function, with the same catalogue,
/// before any thread is started. Returns the exit code.
int contactcheck_main(int argc, char** argv, const DetectorCatalog& catalog);

}  // namespace contactcheck::cli
