// How a scene file describes a body's recorded deformation, and reading it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types/mesh.h"
#include "reference/scene/json_field.h"
#include "reference/scene/mesh_file.h"
#include "reference/scene/point_cache.h"

namespace contactcheck {

/// The "recording" of a body, all defaults filled in.
struct RecordingSpec {
  /// Names of files as resolved, the number taken out: "cloth_" and ".obj" with 4 digits. A point
  /// cache has its whole path before the number.
  std::string before_number, after_number;
  bool numbered = false;
  std::size_t digits = 0;  ///< at least so many, with leading zeros
  std::size_t first = 0, step = 1;
  double scale = 1.0;             ///< of all coordinates, then
  Vec3 translate = Vec3::Zero();  ///< metres

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
RecordingSpec parse_recording_spec(const JsonField& field, const std::filesystem::path& folder);

/// The recorded frames of one body.
class RecordedFrames {
 public:
  /// Opens a point cache. `field` is that of the recording. @throws InputError
  RecordedFrames(RecordingSpec spec, const JsonField& field);

  /// Frames that there are: samples from the first one on, or numbered files without a gap, whether
  /// or not they can be read. At most `most`. @throws InputError when there is none, and for a gap
  /// before a later file
  std::size_t available(std::size_t most) const;
  /// The mesh of the first of the numbered files. @pre the spec is numbered
  LoadedMesh first_mesh() const;
  /// Where the vertices of `mesh` are, placed. @throws InputError where the frame has other
  /// vertices or triangles than the mesh, or is none
  std::vector<Vec3> positions(std::size_t frame, const TriangleMesh& mesh) const;

  const RecordingSpec& spec() const { return spec_; }
  /// "frames cloth_0001.obj and on", "samples of cloth.pc2"
  std::string described() const;

 private:
  std::vector<Vec3> numbered_positions(std::size_t frame, const TriangleMesh& mesh) const;
  std::vector<Vec3> cached_positions(std::size_t frame, const TriangleMesh& mesh) const;
  void refuse_gap(std::size_t missing, std::size_t most) const;
  [[noreturn]] void fail_at(std::size_t frame, const std::string& what) const;

  RecordingSpec spec_;
  JsonField field_;
  std::optional<PointCache> cache_;
};

}  // namespace contactcheck
