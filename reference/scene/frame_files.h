// Files that a simulation has written, named one by one: which of them are the frames of one body.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

struct FrameRules {
  /// "{body}_{frame}.obj", ends of paths: {frame} stands for the number of the frame (-2, 0007,
  /// 0.25), {body} for any part of a name. Without {frame} every file is a body at rest. Where one
  /// is given, files that match none are at rest, too.
  std::vector<std::string> patterns;
  bool repair = false;      ///< see mesh::Folded
  std::string cache_space;  ///< "file", "mesh" or empty: see CacheSpace
};

struct FrameFiles {
  SceneText scene;                     ///< of recorded frames (fixtures/README.md)
  std::vector<std::string> labels;     ///< by frame: the file of the first body that has several
  std::vector<std::string> shown;      ///< by body: its files, as in a shell: "cloth_*.obj"
  std::vector<std::string> unchecked;  ///< files of frames that not every body has
};

/// Which mesh files are frames of one body, and which number is the frame's. Files whose paths
/// differ in numbers alone (and in the case of the extension) are told apart by these:
/// - one of them differs: it is the frame's, unless it stands right behind letters ("ball1") or in
///   a folder, where it may as well count bodies; "frame", "time", "step" and their like before it
///   say that it is the frame's;
/// - several differ: the one with such a word, else the only one with leading zeros.
/// What has two readings is refused with both. Numbers may be negative, where no letter stands
/// before the sign, and decimal behind "t" or "time".
/// Frames of several bodies are those of one number; a body with one number alone stands still. A
/// point cache (PC2, MDD) moves the mesh that is named before it. Bodies are named after their
/// files, or after folders where names are alike. `id`: of the scene.
/// @throws InputError, one sentence: two readings, numbers with a gap or twice, no number that all
/// bodies have, a pattern that no file matches, a cache without a mesh
FrameFiles frame_files(const std::vector<std::filesystem::path>& files, const FrameRules& rules,
                       const std::string& id, const std::vector<Level>& levels);

}  // namespace contactcheck::scene
