// What the results of a shard say about the run that it is a part of: enough for `merge` to tell
// whether shards belong together and are whole.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "reference/suite/suite_request.h"

namespace contactcheck::suite {

/// Files by the name that results have for them, and where they are now.
using NamedFiles = std::map<std::string, std::filesystem::path>;

/// All of it but `files`. @pre request.shard
/// @throws InputError when the program's file cannot be read
results::Shard shard_record(const SuiteRequest& request);

/// Hashes of the files' bytes by name. @throws InputError when one cannot be read
results::Texts file_hashes(const NamedFiles& files);

}  // namespace contactcheck::suite
