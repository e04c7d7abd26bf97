// A scene as a folder that proves its own truth: the deformed surfaces of every frame, certificates
// of which triangles touch and which do not, and the script that checks them (check.py, which
// documents the files).
//
// Certified are the pairs of triangles that share a point and, from them, the pairs of bodies whose
// surfaces do, for the doubles in the PLY files: no pair is missing, none too many. Not certified
// are containment, vertices inside, boxes, cells, margins, lengths and depths, nor that the
// vertices are what the scene's lattices make of its meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// What an export holds, summed over its frames.
struct ExportSummary {
  std::size_t frames = 0;
  std::size_t contacts = 0;  ///< pairs of triangles that touch
  std::size_t gaps = 0;      ///< pairs with boxes that meet and a plane between them
  /// Of the pairs of bodies and triangles, chained over frames: of a complete export, what
  /// results.json calls contact_hash of a detector that is right.
  std::uint64_t contact_hash = 0;
};

/// Writes every `every`-th frame, from 0, into an empty folder; scene.json, without which nothing
/// passes for an export, comes last. Calls `before_frame` before each.
/// @pre a simulated scene has been run; every > 0
/// @throws InputError, one sentence: a vertex is not finite, a file cannot be written
ExportSummary export_scene(const scene::Scene& scene, std::size_t every,
                           const std::filesystem::path& folder,
                           const std::function<void()>& before_frame);

/// Is `folder` a complete export, of whatever scene?
bool is_export(const std::filesystem::path& folder);

}  // namespace contactcheck::judge
