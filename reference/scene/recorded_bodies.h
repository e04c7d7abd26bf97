// The bodies of a scene whose deformation is recorded in files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/types/mesh.h"
#include "reference/mesh/mesh_file.h"
#include "reference/scene/cache_space.h"
#include "reference/scene/lattice_spec.h"
#include "reference/scene/point_cache.h"
#include "reference/scene/scene.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

// How a scene file describes a body's recorded deformation, and reading it.

/// In which space a point cache has its points. Programs write caches in the space of the object
/// or of the world, with y or z up, whatever the mesh is in.
enum class CacheSpace {
  kCompared,  ///< that of the mesh, or another by one change of axes, if sample 0 says so: else
              ///< kFile
  kFile,      ///< that of the scene
  kMesh       ///< by a change of axes and an offset that bring sample 0 to the mesh
};

/// The "recording" of a body, all defaults filled in.
struct RecordingSpec {
  /// Paths as resolved. Numbered files: the number taken out, "cloth_" and ".obj" with 4 digits.
  std::string before_number, after_number;
  std::vector<std::string> files;  ///< or all of them, by frame
  std::string cache;               ///< or a point cache
  std::size_t digits = 0;          ///< at least this many, with leading zeros
  std::size_t first = 0, step = 1;
  mesh::Folded folded = mesh::Folded::kLeftOut;  ///< of the first numbered file, as the mesh
  double scale = 1.0;                            ///< of all coordinates, then
  Vec3 translate = Vec3::Zero();                 ///< metres

  CacheSpace cache_space = CacheSpace::kCompared;

  bool in_meshes() const { return cache.empty(); }
  /// Which file or sample a frame is.
  std::size_t number_of(std::size_t frame) const { return first + frame * step; }
  std::string file_of(std::size_t frame) const;
  /// That path up to the part which has the number: of "scans/f_%d/m.obj", the folder "scans/f_7".
  std::filesystem::path numbered_part(std::size_t frame) const;
  /// The frame whose numbered part has this name in its folder; nothing for other names.
  std::optional<std::size_t> frame_of(const std::string& name) const;
  /// Every frame's vertices, and those at rest. Bits stay where nothing is asked for.
  void place(std::vector<Vec3>& vertices) const;
};

/// @throws InputError
RecordingSpec parse_recording_spec(const text::JsonField& field,
                                   const std::filesystem::path& folder);

/// The recorded frames of one body.
class RecordedFrames {
 public:
  /// Opens a point cache. `field` is that of the recording. @throws InputError
  RecordedFrames(RecordingSpec spec, const text::JsonField& field);

  /// Frames that there are: samples or files from the first one on, or numbered ones without a gap,
  /// whether or not they can be read. At most `most`. @throws InputError when there is none, and
  /// for a gap before a later file
  std::size_t available(std::size_t most) const;
  /// The mesh of the first file. @pre the spec is of meshes
  mesh::LoadedMesh first_mesh() const;
  /// Compares sample 0 of a cache with the mesh as it was given, not yet placed. Returns notes.
  /// @throws InputError where the space of the mesh is asked for, and no change of axes leads there
  std::string find_space(const TriangleMesh& mesh);
  /// Faces of the files that no triangle of the mesh fills.
  void leave_unfilled(std::vector<std::size_t> faces) { unfilled_ = std::move(faces); }
  /// Where the vertices of the shape are, placed. @throws InputError where the frame has other
  /// vertices or triangles than the mesh as it was given, or is none
  std::vector<Vec3> positions(std::size_t frame, const BodyShape& shape) const;

  /// @throws InputError that names the frame and its file
  [[noreturn]] void fail_at(std::size_t frame, const std::string& what) const;

  const RecordingSpec& spec() const { return spec_; }
  /// "frames cloth_0001.obj and on", "samples of cloth.pc2"
  std::string described() const;

 private:
  // Of all vertices as they were given.
  std::vector<Vec3> numbered_positions(std::size_t frame, const BodyShape& shape) const;
  std::vector<Vec3> cached_positions(std::size_t frame, const BodyShape& shape) const;
  void refuse_gap(std::size_t missing, std::size_t most) const;

  RecordingSpec spec_;
  text::JsonField field_;
  std::optional<PointCache> cache_;
  SpaceChange space_;
  std::vector<std::size_t> unfilled_;
};

class RecordedBodies {
 public:
  /// Adds the body of a scene file that has the key "recording". @throws InputError
  void add(const text::JsonField& body, const std::string& name,
           const std::filesystem::path& folder, Scene& scene);
  bool empty() const { return bodies_.empty(); }

  struct Available {
    std::size_t frames = 0;
    std::size_t body = 0;  ///< that has no more
  };
  /// The frames that every recording has, at most `most`. @pre not empty. @throws InputError
  Available available(std::size_t most) const;

  /// Says in scene.origins of which recordings only the first `frames` are used, which may have up
  /// to `most`. @throws InputError
  void note_unused(std::size_t frames, std::size_t most, Scene& scene) const;

  /// Fills scene.recorded, with the nodes of the scripted bodies too, and scene.fits.
  /// @pre scene.frames and scene.time_step are set, to no more frames than are available
  void fill(Scene& scene) const;

 private:
  struct Recorded {
    std::size_t body;
    LatticeSpec lattice;
    RecordedFrames frames;
  };
  std::vector<Recorded> bodies_;
};

}  // namespace contactcheck::scene
