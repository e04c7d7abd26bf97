// Puts the results of a run's shards together.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/suite/suite_request.h"

#include "reference/results/results.h"
#include "reference/suite/shard.h"

namespace contactcheck::suite {

// The results of a run's shards: do they belong together, and is all there?

struct ShardResults {
  std::filesystem::path file;  ///< a results.json
  results::Results results;

  /// @pre results.shard, as checked_shards looks after
  const results::Shard& record() const { return *results.shard; }
  Shard shard() const { return {record().index, record().of}; }
  /// The folder of the files that the results name.
  std::filesystem::path folder() const { return file.parent_path(); }
};

/// Returns them in the order of their indices.
/// @throws InputError, naming files, when some are no shards; are of different versions or builds
/// of the program, libraries, plug-ins, settings, scenes, detectors or goals; were timed on
/// different machines; when a shard is missing or there twice; when one lacks a scene or a
/// detector, or a file that it names is missing or is not as the shard has written it
std::vector<ShardResults> checked_shards(std::vector<ShardResults> shards);

/// Writes into `out` what the run would have written had it not been sharded, except timings:
/// results.json, recordings, contacts and cases, these numbered as the whole run numbers them.
/// Goals and known defects are set beside the whole again. `merged` in the results lists the
/// shards' commands; the command is the run's. Returns the results.
/// @pre `shards` are checked_shards, none of them in `out`
/// @throws InputError when something cannot be read or written
results::Results merge_shards(const std::vector<ShardResults>& shards,
                              const std::filesystem::path& out,
                              const results::KnownDefects& known_defects, SuiteOutcome* outcome);

}  // namespace contactcheck::suite
