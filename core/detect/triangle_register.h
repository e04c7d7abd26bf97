#pragma once

#include "core/detect/registry.h"

namespace contactcheck {

/// Adds aabb-tree, spatial-hash and sphere-tree: historic broad phases over triangles, each with
/// core's exact test of two triangles behind it.
void register_triangle_detectors(DetectorCatalog& catalog);

}  // namespace contactcheck
