// The bodies of a scene whose deformation comes from files.
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

// The recorded deformation of a body in a scene file, and reading it.

/// The coordinate system of a point cache. Programs write caches in object or world space, with y
/// or z up, whatever the mesh uses.
enum class CacheSpace {
  kCompared,  ///< that of the mesh, or another by one change of axes, if sample 0 says so: else
              ///< kFile
  kFile,      ///< that of the scene
  kMesh       ///< mapped by a change of axes and an offset that bring sample 0 to the mesh
};

/// The "recording" of a body, all defaults filled in.
struct RecordingSpec {
  /// Resolved paths. Numbered files: the path around the number, "cloth_" and ".obj" with 4 digits.
  std::string before_number, after_number;
  std::vector<std::string> files;  ///< or a list of files, by frame
  std::string cache;               ///< or a point cache
  std::size_t digits = 0;          ///< minimum number of digits, with leading zeros
  std::size_t first = 0, step = 1;
  mesh::Folded folded = mesh::Folded::kLeftOut;  ///< for the first numbered file, as for the mesh
  double scale = 1.0;                            ///< multiplies all coordinates
  Vec3 translate = Vec3::Zero();                 ///< metres, added after scaling

  CacheSpace cache_space = CacheSpace::kCompared;

  bool in_meshes() const { return cache.empty(); }
  /// The number of the file or sample of a frame.
  std::size_t number_of(std::size_t frame) const { return first + frame * step; }
  std::string file_of(std::size_t frame) const;
  /// The path up to the part with the number: for "scans/f_%d/m.obj" the folder "scans/f_7".
  std::filesystem::path numbered_part(std::size_t frame) const;
  /// The frame whose numbered part has this file name; nothing for other names.
  std::optional<std::size_t> frame_of(const std::string& name) const;
  /// Scales and translates vertices, of frames or at rest. Bits stay the same if neither is set.
  void place(std::vector<Vec3>& vertices) const;
};

/// @throws InputError
RecordingSpec parse_recording_spec(const text::JsonField& field,
                                   const std::filesystem::path& folder);

/// The recorded frames of one body.
class RecordedFrames {
 public:
  /// Opens a point cache. `field`: the recording's, for messages. @throws InputError
  RecordedFrames(RecordingSpec spec, const text::JsonField& field);

  /// The number of available frames, at most `most`: samples or files from the first one on, or
  /// numbered files without a gap, readable or not. @throws InputError if there is none, or for a
  /// gap before a later file
  std::size_t available(std::size_t most) const;
  /// The mesh of the first file. @pre the spec names mesh files
  mesh::LoadedMesh first_mesh() const;
  /// Compares sample 0 of a cache with the mesh as given, before place(). Returns notes.
  /// @throws InputError if the space of the mesh is requested and no change of axes leads to it
  std::string find_space(const TriangleMesh& mesh);
  /// Sets the faces of the files for which the mesh has no triangles.
  void leave_unfilled(std::vector<std::size_t> faces) { unfilled_ = std::move(faces); }
  /// The vertices of the shape, after place(). @throws InputError if the frame's vertices or
  /// triangles differ from those of the mesh as given, or the frame does not exist
  std::vector<Vec3> positions(std::size_t frame, const BodyShape& shape) const;

  /// @throws InputError naming the frame and its file
  [[noreturn]] void fail_at(std::size_t frame, const std::string& what) const;

  const RecordingSpec& spec() const { return spec_; }
  /// "frames cloth_0001.obj and on", "samples of cloth.pc2"
  std::string described() const;

 private:
  // All vertices as given, before any are dropped.
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
    std::size_t body = 0;  ///< a body that has no more frames
  };
  /// The frames that every recording has, at most `most`. @pre not empty. @throws InputError
  Available available(std::size_t most) const;

  /// Notes in scene.origins the recordings of which only the first `frames` are used, though they
  /// have more (counted up to `most`). @throws InputError
  void note_unused(std::size_t frames, std::size_t most, Scene& scene) const;

  /// True if the nodes of some body are those of a lattice that is fitted to its vertices.
  bool fits_lattices() const;
  /// The nodes of every body of `scene`, to which these were added, in a frame; scripted ones, too.
  /// @pre nothing is fitted. @throws InputError
  std::vector<std::vector<Vec3>> nodes(const Scene& scene, std::size_t frame) const;

  /// Fills scene.recorded, including the nodes of scripted bodies, and scene.fits.
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
