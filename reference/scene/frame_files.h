// Files that a simulation has written, named one by one: which of them are the frames of one body.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

struct FrameFiles {
  SceneText scene;                  ///< of recorded frames (fixtures/README.md)
  std::vector<std::string> labels;  ///< by frame: the file of the first body that has numbered ones
  std::vector<std::string> shown;   ///< by body: its files, as in a shell: "cloth_*.obj"
};

/// Mesh files whose names differ in one number alone are the frames of one body, from the lowest
/// number to the highest. A point cache (PC2, MDD) moves the mesh that is named before it. Any
/// other mesh stands still. Bodies are named after their files, or after folders where names are
/// alike. Frames end where the shortest body's do. `id`: of the scene. @throws InputError, one
/// sentence: numbers with a gap, a cache without a mesh
FrameFiles frame_files(const std::vector<std::filesystem::path>& files, const std::string& id,
                       const std::vector<Level>& levels);

}  // namespace contactcheck::scene
