// The bodies of a scene whose deformation is recorded in files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "reference/scene/json_field.h"
#include "reference/scene/lattice_spec.h"
#include "reference/scene/recording_spec.h"
#include "reference/scene/scene.h"

namespace contactcheck {

class RecordedBodies {
 public:
  /// Adds the body of a scene file that has the key "recording". @throws InputError
  void add(const JsonField& body, const std::string& name, const std::filesystem::path& folder,
           Scene& scene);
  bool empty() const { return bodies_.empty(); }

  struct Available {
    std::size_t frames = 0;
    std::size_t body = 0;  ///< that has no more
  };
  /// The frames that every recording has, at most `most`. @pre not empty. @throws InputError
  Available available(std::size_t most) const;

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

}  // namespace contactcheck
