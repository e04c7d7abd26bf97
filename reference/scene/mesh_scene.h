// A scene made from mesh files: `run --mesh a.obj --mesh b.obj --motion approach`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

struct MeshSceneRequest {
  static constexpr std::size_t kMostMeshes = 7;  ///< one in the middle and one per axis direction

  std::vector<std::filesystem::path> meshes;  ///< the same file may be named twice
  std::string motion = "approach";
  bool repair = false;               ///< see mesh::Folded
  std::optional<double> size = 1.0;  ///< metres, largest side of each mesh; none: as in the file

  /// One mesh that is judged against itself.
  bool meets_itself() const {
    return meshes.size() == 1 && (motion == "fold" || motion == "twist");
  }
};

/// The motions of several meshes. approach: the others come to the first mesh, touch it and leave
/// again. press: the same, but deeper, and all are squashed along the path. twist: the same, and
/// all are twisted about the path during contact. pass: the second mesh slides past the first,
/// touching it.
///
/// Every motion starts with disjoint bodies (a plane separates any two of them), keeps them in
/// contact for at least a tenth of the time, and separates them again.
///
/// A single mesh, judged against itself, has the motions fold (its longest axis is bent to more
/// than a ring, so that its ends intersect) and twist (the same, twisted by one turn). fold is not
/// listed.
const std::vector<std::string>& motion_names();

/// The scene file of the request, with paths relative to `folder`: bodies named after the files, in
/// lattices of about 150 kept cells; the first one at the origin, each other one comes from a
/// different side. The oracle finds where the surfaces meet (approach.h).
/// @throws InputError, one sentence: an unknown motion, a file without a mesh, a mesh that is a
/// point or too large, meshes that no axis brings into contact, a wrong number of meshes
SceneText mesh_scene(const MeshSceneRequest& request, const std::filesystem::path& folder);

/// Notes on sizes, "cow: 10.4 m, scaled to 1 m (--size file keeps it)", on reading the files and on
/// mesh defects, "cow: 3 boundary-edge (first: triangle 17)", and a warning if one mesh is over a
/// hundred times as large as another.
/// @throws InputError as mesh_scene
std::vector<std::string> mesh_notes(const MeshSceneRequest& request);

/// The path of `mesh` in a scene file in `folder`. Links are resolved, since ".." of a link is not
/// the folder that contains it.
/// @throws InputError for links that lead in a circle
std::string mesh_path_from(const std::filesystem::path& folder, const std::filesystem::path& mesh);

}  // namespace contactcheck::scene
