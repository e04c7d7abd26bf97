// A scene made of mesh files alone: `run --mesh a.obj --mesh b.obj --motion approach`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

struct MeshSceneRequest {
  static constexpr std::size_t kMostMeshes = 7;  ///< one in the middle, one from each side

  std::vector<std::filesystem::path> meshes;  ///< the same file may be named twice
  std::string motion = "approach";
  bool repair = false;               ///< see mesh::Folded
  std::optional<double> size = 1.0;  ///< metres, each mesh's largest side; none: as in the file

  /// One mesh, to be judged against itself.
  bool meets_itself() const {
    return meshes.size() == 1 && (motion == "fold" || motion == "twist");
  }
};

/// approach: the others come to the first mesh, touch it and leave again. press: the same, going
/// deeper, and all are squashed along the way. twist: the same, and all are twisted about the way
/// while they touch. pass: the second mesh slides past the first, touching it.
///
/// Every motion starts with disjoint bodies (a plane separates the first body from each other one,
/// and the other ones from one another), leads into contact for at least a tenth of the time, and
/// separates them again.
///
/// One mesh is judged against itself. fold: its longest axis is bent to more than a ring, so that
/// its ends sink into one another. twist: the same, twisted by a turn.
/// Of several meshes:
const std::vector<std::string>& motion_names();

/// The scene file that the request amounts to, with paths relative to `folder`: bodies named after
/// the files, in lattices of about 150 kept cells; the first one in the origin, the others come to
/// it, each from a side of its own. Where the surfaces meet is found with the oracle (approach.h).
/// @throws InputError, one sentence: an unknown motion, a file that is no mesh, a mesh that is a
/// point or too large, meshes that no axis leads into contact, a number of meshes that is not meant
SceneText mesh_scene(const MeshSceneRequest& request, const std::filesystem::path& folder);

/// What becomes of the sizes in the files, "cow: 10.4 m, scaled to 1 m (--size file keeps it)",
/// with what reading them and the mesh check found, "cow: 3 boundary-edge (first: triangle 17)";
/// and a warning where one is over a hundred times as large as another.
/// @throws InputError as mesh_scene
std::vector<std::string> mesh_notes(const MeshSceneRequest& request);

/// How a scene file in `folder` names the mesh. Through no link: a link's ".." is not the folder
/// that names it.
/// @throws InputError for links that lead in a circle
std::string mesh_path_from(const std::filesystem::path& folder, const std::filesystem::path& mesh);

}  // namespace contactcheck::scene
