// What several commands check alike, before they write a byte.
#pragma once

#include <filesystem>
#include <string>

#include "reference/scene/frame_files.h"

namespace contactcheck::cli {

/// Creates --out where it is missing. @throws InputError when it cannot be written
void check_out(const std::filesystem::path& out);

/// True if a target is a mesh file, by its ending: ids of scenes and suites have none.
bool names_mesh(const std::string& target);

/// Frames of a simulation, between which --between looks. @throws InputError if a file is of a
/// frame that not every body has
void refuse_left_out(const scene::FrameFiles& files);

}  // namespace contactcheck::cli
