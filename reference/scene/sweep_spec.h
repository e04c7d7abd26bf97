// How a scene file asks for poses of two bodies at given separations.
#pragma once

#include "reference/scene/json_field.h"
#include "reference/scene/scene.h"

namespace contactcheck {

/// The "sweep" of a scene, all defaults filled in. @throws InputError
SweepSpec parse_sweep(const JsonField& field);

}  // namespace contactcheck
