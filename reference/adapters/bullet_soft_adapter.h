// Bullet's soft bodies as detectors. Bullet's types stay in the .cpp files and in the headers that
// say so.
//
//   bullet-vf  vertices against faces, within margins: see bullet_vf.h
//   bullet-cl  convex hulls of clusters of vertices: see bullet_cl.h
//
// Both are queried on the given vertices and never stepped, in single precision, in a world of
// their own scale.
#pragma once

#include <string>

#include "core/detect/registry.h"

namespace contactcheck {

void register_bullet_soft_detectors(DetectorCatalog& catalog);

/// As Bullet's headers say, with the precision it is built in, e.g. "3.24 float".
std::string bullet_version();

}  // namespace contactcheck
