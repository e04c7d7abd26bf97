// Embree's scene-against-scene collision as a detector: the fast peer. Embree's types stay in the
// .cpp.
//
//   embree  one hierarchy of boxes per body, refitted; rtcCollide names the pairs of triangles
//           whose boxes overlap; core's exact test decides
//
// Embree only culls, in single precision, with boxes rounded outward: the answer is exact for all
// finite doubles, closed (touching is contact) and about surfaces. rtcCollide cannot stop early, so
// the question `body` costs the whole traversal too and saves tests of triangles only. Single
// threaded, and it leaves the process's limit on oneTBB's threads alone.
#pragma once

#include <string>

#include "core/detect/registry.h"

namespace contactcheck {

void register_embree_detector(DetectorCatalog& catalog);

/// As Embree's headers say, e.g. "3.13.5".
std::string embree_version();

}  // namespace contactcheck
