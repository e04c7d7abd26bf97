// Puts the results of a run's shards together.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/run/shard_set.h"
#include "reference/run/suite_run.h"

namespace contactcheck {

/// Writes into `out` what the run would have written had it not been dealt out, times aside:
/// results.json, recordings, contacts and cases, these numbered as the whole run numbers them.
/// Goals and known defects are set beside the whole again. `merged` in the results lists the
/// shards' commands; the command is the run's. Returns the results.
/// @pre `shards` are checked_shards, none of them in `out`
/// @throws InputError when something cannot be read or written
results::Results merge_shards(const std::vector<ShardResults>& shards,
                              const std::filesystem::path& out, const KnownDefects& known_defects,
                              SuiteOutcome* outcome);

}  // namespace contactcheck
