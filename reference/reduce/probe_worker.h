// The process that asks a detector: entry of a hidden subcommand, and what it is sent.
#pragma once

#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/reduce/candidate.h"

namespace contactcheck::reduce {

/// A frame and the levels at which it is to be judged, as one message.
std::string probe_request(const Snapshot& snapshot, const std::vector<Level>& levels);

/// Answers requests on the descriptor until the other side closes it: first an empty message when
/// the truth is known and the detector's turn comes, then the verdict. Returns the exit code.
int run_probe_worker(const std::string& detector, const DetectorCatalog& catalog, int channel_fd);

}  // namespace contactcheck::reduce
