// A scene as a folder that proves its ground truth: the deformed surfaces of every frame,
// certificates of which triangles touch and which do not, and the script that checks them
// (check.py, which documents the files).
//
// The certificates cover, for the doubles in the PLY files, exactly the pairs of triangles that
// share a point and the pairs of bodies whose surfaces do. They do not cover containment, vertices
// inside, boxes, cells, margins, lengths and depths, nor that lattices and meshes give these
// vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// Sums over the exported frames.
struct ExportSummary {
  std::size_t frames = 0;
  std::size_t contacts = 0;  ///< pairs of triangles that touch
  std::size_t gaps = 0;      ///< pairs with overlapping boxes and a separating plane
  /// Hash of the pairs of bodies and triangles, chained over frames. For an export of all frames it
  /// equals the contact_hash, in results.json, of a detector that is right.
  std::uint64_t contact_hash = 0;
};

/// Writes every `every`-th frame, from 0, into an empty folder; scene.json comes last, and a folder
/// without it is not an export. Calls `before_frame` before each frame.
/// @pre a simulated scene has been simulated; every > 0
/// @throws InputError, one sentence, if a vertex is not finite or a file cannot be written
ExportSummary export_scene(const scene::Scene& scene, std::size_t every,
                           const std::filesystem::path& folder,
                           const std::function<void()>& before_frame);

}  // namespace contactcheck::judge
