// What the results of a shard say about the run that it is a part of: enough for `merge` to tell
// whether shards belong together and are whole.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "reference/run/suite_run.h"

namespace contactcheck {

/// Files by the name that results have for them, and where they are now.
using NamedFiles = std::map<std::string, std::filesystem::path>;

/// `index`, `of`, `command` (of the whole run), `program` (hash of its file), `settings`, `goals`,
/// and `scenes`, those of the whole run. @pre request.shard
/// @throws InputError when the program's file cannot be read
nlohmann::ordered_json shard_record(const SuiteRequest& request);

/// Hashes of the files' bytes by name. @throws InputError when one cannot be read
nlohmann::ordered_json file_hashes(const NamedFiles& files);

}  // namespace contactcheck
