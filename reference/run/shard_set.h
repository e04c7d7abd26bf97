// The results of a run's shards: do they belong together, and is all there?
#pragma once

#include <filesystem>
#include <vector>

#include "reference/results/results.h"
#include "reference/run/shard.h"

namespace contactcheck {

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

}  // namespace contactcheck
