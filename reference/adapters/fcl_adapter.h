// FCL's mesh collision as detectors. FCL's types stay in the .cpp.
//
//   fcl-aabb     axis-aligned boxes, traversed directly: FCL at its best
//   fcl-obbrss   oriented boxes and swept spheres, through fcl::collide
//   fcl-collide  axis-aligned boxes through fcl::collide, the documented call
//
// All three hold one hierarchy per body, replace its vertices and refit it bottom-up on every
// update, and skip body pairs whose boxes do not meet. They answer about surfaces, closed
// (touching is contact), in double; a body within another is no contact. They claim no exactness:
// FCL's triangle test rounds, and its oriented boxes miss pairs by rounding.
#pragma once

#include <string>

#include "core/detect/registry.h"

namespace contactcheck {

void register_fcl_detectors(DetectorCatalog& catalog);

/// As FCL's headers say, e.g. "0.7.0".
std::string fcl_version();

}  // namespace contactcheck
