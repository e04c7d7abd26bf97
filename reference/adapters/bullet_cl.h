// Bullet's soft bodies with cluster contacts (CL_SS) as the detector `bullet-cl`.
//
// Each body is divided at rest into clusters of vertices; two bodies are in contact when the convex
// hulls of two of their clusters are nearer than the sum of the margins (strictly) or overlap, by
// GJK and EPA in single precision. Hulls of concave or curved pieces hold space that the surface
// does not: contact is reported across a gap, and for a thin shell within another. Judged at
// `body`.
#pragma once

#include <memory>

#include "core/detect/detector.h"

namespace contactcheck {

/// `clusters`: at most so many per body. `margin`: of one body, metres. `scale`: world units per
/// metre; 0: from the scene.
std::unique_ptr<Detector> make_bullet_cl(int clusters, double margin, double scale);

}  // namespace contactcheck
