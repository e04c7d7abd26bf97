// libccd's two intersection algorithms as detectors. libccd's types stay in the .cpp files.
//
//   libccd-gjk  GJK, and EPA for depths
//   libccd-mpr  Minkowski portal refinement (XenoCollide), for both
//
// Option `pieces`:
//   triangles  each pair of triangles whose boxes overlap (core's refitted trees) as two hulls of
//              three points; answers which pairs of triangles and of bodies are in contact
//   boxes      the mapped FFD-AABBs of kept cells (core's spatial hash on their bounding boxes) as
//              hulls of eight corners; answers which pairs of cells and of bodies are in contact
//              and, by the question `contacts`, depth (metres) and direction of the shortest way
//              to part two boxes. Needs a lattice for every body.
// Option `iterations`: see libccd_call.h; a pair that takes more counts as no contact, and notes()
// says so. Option `scale`: libccd is fed points times this, and its tolerances, which are absolute,
// are in these units; pieces of millimetres need one (see libccd_call.cpp). A power of two rounds
// nothing. Depths are in metres whatever the scale.
//
// In double, not exact. GJK means touching to be contact, and loses some of it; MPR means it to be
// none, and reports some (prior work, C8).
// Sources: van den Bergen, "Collision Detection in Interactive 3D Environments", 2003; Snethen,
// "XenoCollide", Game Programming Gems 7, 2008.
#pragma once

#include <string>

#include "core/detect/registry.h"

namespace contactcheck {

void register_libccd_detectors(DetectorCatalog& catalog);

/// As libccd's files say; "2.1 (its own files say 2.0)" when its headers are those of 2.1.
std::string libccd_version();

}  // namespace contactcheck
