// Bullet's soft bodies with vertex-face contacts (VF_SS) as the detector `bullet-vf`.
//
// An unsigned proximity query in single precision: every vertex of one body that is nearer than the
// sum of the two margins to a triangle of the other, strictly, both ways; nothing is said about
// inside and outside, and edges that cross far from any vertex are not seen. Judged at `near` and
// `body`; its figures at `vertex` are informative.
#pragma once

#include <memory>

#include "core/detect/detector.h"

namespace contactcheck {

/// `margin`: of one body, metres. `scale`: world units per metre; 0: from the scene.
std::unique_ptr<Detector> make_bullet_vf(double margin, double scale);

}  // namespace contactcheck
