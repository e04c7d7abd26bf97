// A worker: one process and one scene, which it judges with all detectors, or in which it times the
// turns of one pass. It is started fresh (exec) before any thread exists; its parent watches it
// through SharedProgress (supervisor.h).
#pragma once

#include <filesystem>

#include "core/detect/registry.h"

namespace contactcheck::suite {

/// Entry of the hidden subcommand. `catalog` makes the job's detectors. `progress_fd`: an inherited
/// descriptor of the shared page, or -1 to run without a parent. Writes the job's answer file.
/// Returns the exit code.
int run_worker(const std::filesystem::path& job_file, const DetectorCatalog& catalog,
               int progress_fd);

}  // namespace contactcheck::suite
