#pragma once

#include "core/detect/registry.h"

namespace contactcheck {

/// The FFD-AABB family: ffd-grid, ffd-aabb, ffd-aabb-sphere, -sphere2, -sphereN, each with `+tri`.
void register_ffd_detectors(DetectorCatalog& catalog);

}  // namespace contactcheck
