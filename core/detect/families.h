// What each family of core's detectors adds to the catalogue.
#pragma once

#include "core/detect/registry.h"

namespace contactcheck {

/// Adds ffd-grid, ffd-aabb, ffd-aabb-sphere, -sphere2, -sphereN, each also with `+tri`.
void register_ffd_detectors(DetectorCatalog& catalog);

/// Adds aabb-tree, spatial-hash and sphere-tree: historic broad phases over triangles, each with
/// core's exact test of two triangles behind it.
void register_triangle_detectors(DetectorCatalog& catalog);

/// Adds bd-tree.
void register_bd_tree(DetectorCatalog& catalog);

/// Adds ffd-lazy and full-refit.
void register_lazy_detectors(DetectorCatalog& catalog);

/// Adds swept-aabb, which finds contact within steps.
void register_step_detectors(DetectorCatalog& catalog);

/// Adds the detectors of elementary impacts, exact and root-finder.
void register_impact_detectors(DetectorCatalog& catalog);

}  // namespace contactcheck
