// A simulated scene with bodies that another model deforms.
#pragma once

#include <filesystem>
#include <string>

#include "core/dynamics/material.h"
#include "reference/scene/scene.h"

namespace contactcheck {

/// What deforms the bodies of a simulated scene: "mass-spring"; "mixed" where they differ.
/// @pre the scene is simulated @throws InputError when none of its bodies can be moved
std::string deformer_of(const Scene& scene);

/// Writes the scene of `file`, every material made the equivalent one of `model`
/// (core/dynamics/equivalent_material.h), into `folder`, shape matching with substeps no longer
/// than its relaxation time; the id gets "-MODEL" behind it. Returns
/// the new file. @throws InputError for scenes that cannot be read
std::filesystem::path write_deformer_variant(const std::filesystem::path& file,
                                             DeformableModel model,
                                             const std::filesystem::path& folder);

}  // namespace contactcheck
