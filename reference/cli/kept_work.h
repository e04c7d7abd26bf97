// What an interrupted command has left in its folder, and what the next one may do with it.
#pragma once

#include <filesystem>
#include <string>

namespace contactcheck::cli {

struct KeptWork {
  std::string left;      ///< "an interrupted check has left 5 checked frames"; empty: nothing
  std::string identity;  ///< of what was done: lines "name: value"
  std::string command;   ///< that did it
};

/// The identity of what a command does: this program, and `lines`.
std::string identity_of(const std::string& lines);

/// @throws InputError, one sentence: what is there would be lost, since it is not of this
/// `identity` or is not to be resumed, and is not to be overwritten
void require_nothing_lost(const std::filesystem::path& out, const KeptWork& kept,
                          const std::string& identity, bool resume, bool overwrite);

}  // namespace contactcheck::cli
