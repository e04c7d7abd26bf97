// Detectors that do what no detector should: they strike at the process they run in, or change it
// for everybody. Each answers with the truth otherwise.
#pragma once

#include "core/detect/registry.h"

namespace contactcheck::test {

/// Adds the detectors `fault-...`. Each strikes in frame `frame`, in `phase` prepare, update, query
/// or again (when that frame is asked for a second time: while it is timed).
void register_process_faults(DetectorCatalog& catalog);

}  // namespace contactcheck::test
