// A body's motion in a scene file (fixtures/README.md, "Scenes").
#pragma once

#include "core/deform/body.h"
#include "core/deform/motion.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

/// The motion of a body with this shape. Without a position, the body's rest box keeps its place.
/// @throws InputError
Motion parse_motion(const text::JsonField& field, const BodyShape& shape);

/// True without deformer, spin and position: the body rests, bit for bit.
bool is_rest(const Motion& motion);

}  // namespace contactcheck::scene
