// A scene in lattices of another resolution.
#pragma once

#include <cstddef>
#include <filesystem>

#include "reference/scene/scene.h"

namespace contactcheck {

/// Writes the scene of `file` with `factor` times as many kept cells per body into `folder`; the id
/// gets "-lattice-PERCENT" behind it. Returns the new file.
/// @throws InputError for what is no scene file, or has a body whose lattice gives no number of
/// cells
std::filesystem::path write_lattice_variant(const std::filesystem::path& file, double factor,
                                            const std::filesystem::path& folder);

/// The largest distance of a deformed vertex of one scene from the same vertex of the other, over
/// all frames, metres. @throws InputError when they do not have the same meshes
double deviation(const Scene& scene, const Scene& variant);

}  // namespace contactcheck
