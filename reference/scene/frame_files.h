// Which of the named files of a simulation are the frames of one body.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

struct FrameRules {
  /// "{body}_{frame}.obj", matched against ends of paths: {frame} is the number of the frame (-2,
  /// 0007, 0.25), {body} any part of a name. Without {frame} every file is a body at rest. If
  /// patterns are given, files that match none are at rest too.
  std::vector<std::string> patterns;
  bool repair = false;      ///< see mesh::Folded
  std::string cache_space;  ///< "file", "mesh" or empty: see CacheSpace
};

struct FrameFiles {
  SceneText scene;                     ///< with recorded frames (fixtures/README.md)
  std::vector<std::string> labels;     ///< by frame: the file of the first body that has several
  std::vector<std::string> shown;      ///< by body: its files as a shell pattern: "cloth_*.obj"
  std::vector<std::string> unchecked;  ///< files of frames that some body lacks
  std::vector<std::vector<std::filesystem::path>> moving;  ///< by frame: the files of moving bodies
  std::vector<std::filesystem::path> others;  ///< of all frames: bodies at rest, and caches
};

/// Finds the mesh files that are frames of one body, and the number of each frame. If paths differ
/// only in numbers (and in the case of the extension):
/// - One number differs: it is the frame's, unless it follows letters directly ("ball1") or is in a
///   folder, where it may count bodies; "frame", "time", "step" and similar words before it make it
///   the frame's.
/// - Several differ: the one with such a word, else the only one with leading zeros. An ambiguous
///   list is refused with both readings. Numbers may be negative if no letter precedes the sign,
///   and decimal after "t" or "time". Bodies share the frames with the same number; a body with one
///   number only is at rest. A point cache (PC2, MDD) moves the mesh that is named before it.
///   Bodies are named after their files, or after folders if the names are equal. `id`: of the
///   scene.
/// @throws InputError, one sentence: an ambiguous list, a missing or repeated number, no number
/// common to all bodies, a pattern that matches no file, a cache without a mesh
FrameFiles frame_files(const std::vector<std::filesystem::path>& files, const FrameRules& rules,
                       const std::string& id, const std::vector<Level>& levels);

}  // namespace contactcheck::scene
