// Detectors that err in ways of which the minimal case is known.
#pragma once

#include "core/detect/registry.h"

namespace contactcheck::test {

/// Adds the detectors `fault-misses-...` and `fault-crashes-...`.
void register_geometry_faults(DetectorCatalog& catalog);

}  // namespace contactcheck::test
