// The results of a run's shards: do they belong together, and is all there?
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "reference/run/shard.h"

namespace contactcheck {

struct ShardResults {
  std::filesystem::path file;      ///< a results.json
  nlohmann::ordered_json results;  ///< as fixtures/results.schema.json says

  const nlohmann::ordered_json& record() const { return results.at("shard"); }
  Shard shard() const;
  /// The folder of the files that the results name.
  std::filesystem::path folder() const { return file.parent_path(); }
};

/// Returns them in the order of their indices.
/// @throws InputError, naming files, when some are no shards; are of different versions or builds
/// of the program, libraries, settings, scenes, detectors or goals; were timed on different
/// machines; when a shard is missing or there twice; when one lacks a scene or a detector, or a
/// file that it names is missing or is not as the shard has written it
std::vector<ShardResults> checked_shards(std::vector<ShardResults> shards);

}  // namespace contactcheck
