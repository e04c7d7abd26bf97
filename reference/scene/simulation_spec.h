// A simulation in a scene file: steps, gravity, ground and driving detector at the root, material
// and initial velocity on bodies (fixtures/README.md, "Scenes").
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/deform/body.h"
#include "core/deform/motion.h"
#include "core/dynamics/material.h"
#include "reference/scene/scene.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

/// The name of a model in scene files: "mass-spring".
const char* name_of(DeformableModel model);
/// @pre name_of returns this name for some model
DeformableModel model_named(std::string_view name);
/// All names, in the order of the documentation.
const std::vector<std::string>& model_names();

/// The root's "simulation"; materials and velocities stay empty.
/// @throws InputError
SimulationSpec parse_simulation(const text::JsonField& field);

/// A body's "material".
/// @throws InputError
Material parse_material(const text::JsonField& field);

/// Adds the material and velocity of the next body. `body` is its whole field; `motion` the parsed
/// "motion".
/// @throws InputError also if the body has no lattice to deform, or a motion that changes with time
void add_simulated_body(const text::JsonField& body, const BodyShape& shape, const Motion& motion,
                        SimulationSpec& simulation);

/// Refuses "material" and "velocity" of a body in a scene that is not simulated.
/// @throws InputError
void require_no_simulation_keys(const text::JsonField& body);

}  // namespace contactcheck::scene
