// Bullet's GImpact, concave meshes against each other, as a detector. Bullet's types stay in the
// .cpp.
//
//   bullet-gimpact  quantised box trees, refitted; triangles clipped against each other in pairs
//
// Options: `margin` (metres, per mesh; two triangles count from twice that apart), `scale` (world
// units per metre; 0: from the scene, see bullet_scale.h).
#pragma once

#include "core/detect/registry.h"

namespace contactcheck {

void register_gimpact_detector(DetectorCatalog& catalog);

}  // namespace contactcheck
