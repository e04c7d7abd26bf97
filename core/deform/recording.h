// Recordings: the lattice nodes of every body per frame, with meshes and embeddings. A recording is
// what makes a comparison repeatable on another machine. The format is described in
// fixtures/README.md, "Recordings (.ccr)". Needs no library.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/semantics.h"

namespace contactcheck {

struct Recording {
  std::string scene;
  std::vector<Body> bodies;  ///< instances share one shape, by content hash
  double time_step = 0.0;    ///< seconds
  std::vector<std::vector<std::vector<Vec3>>> frames;  ///< nodes [frame][body][node]
  std::vector<Level> levels = {};                      ///< judged levels; empty: unspecified
};

/// Writes under a temporary name, then renames. @throws InputError with the path when that fails.
void write_recording(const std::filesystem::path& file, const Recording& recording);

/// @throws InputError: not a recording, wrong version, truncated, inconsistent, non-finite value
Recording read_recording(const std::filesystem::path& file);

/// The same in memory; `name` is the name of the file in messages.
std::string recording_bytes(const Recording& recording, const std::string& name);
Recording read_recording_bytes(const std::string& bytes, const std::string& name);

}  // namespace contactcheck
