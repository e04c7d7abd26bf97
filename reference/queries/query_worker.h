// Detectors from outside that are asked about queries in a process of their own: a crash, a hang or
// a flood ends their row alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/detect/registry.h"
#include "reference/queries/query_session.h"

namespace contactcheck::queries {

struct WorkerLimits {
  double call_seconds = 60;                             ///< of one query, and of the start
  std::uint64_t memory_bytes = std::uint64_t{8} << 30;  ///< of the worker and all it started
};

/// Asks a plug-in's detector in a worker. `record`: the plug-in as plugin::to_json writes it;
/// `executable`: this program, whose hidden subcommand query-worker is run_query_worker().
/// In single precision it is taken to be fed the floats of all coordinates.
QueryDetector worker_detector(const ImpactDetectorInfo& info, const DetectorSpec& spec,
                              const std::string& record, const std::filesystem::path& executable,
                              const WorkerLimits& limits);

/// The worker's side: answers what the shared page asks until it is told to end. `catalog` holds
/// the plug-in. Returns the exit code.
int run_query_worker(const std::string& detector, const DetectorCatalog& catalog, int page_fd);

}  // namespace contactcheck::queries
