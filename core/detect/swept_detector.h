// The plain detector of contact within steps: trees of boxes over both ends of a step, and the
// exact tests of all elements whose boxes meet.
#pragma once

#include <memory>

#include "core/detect/detector.h"

namespace contactcheck {

/// What a detector claims that finds all contact within steps between bodies, and, with `self`,
/// within them.
Semantics exact_step_semantics(bool self);

/// Maps all vertices at both ends, and fits a tree of boxes of triangles over the step: a triangle
/// that moves straight stays within the box of its six places, since boxes are convex.
std::unique_ptr<Detector> make_swept_aabb();

}  // namespace contactcheck
