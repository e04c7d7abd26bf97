// Detectors that do what no detector should: they strike at the process they run in, or change it
// for everybody. Each answers with the truth otherwise.
#pragma once

#include "core/detect/registry.h"

namespace contactcheck::test {

/// Adds the detectors `fault-...`. Each strikes in frame `frame`, in `phase` prepare, update,
/// query, again (when a frame of that number is asked for a second time: between frames) or timed
/// (in a pass that is timed; not in its first frame); update-again and update-timed strike in
/// update.
void register_process_faults(DetectorCatalog& catalog);

}  // namespace contactcheck::test
