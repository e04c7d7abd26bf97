// Suites: named lists of scenes and detectors (fixtures/README.md, "Suites").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contactcheck {

struct Suite {
  std::string id;
  std::string title;                   ///< one line
  std::vector<std::string> scenes;     ///< ids, all different; at least one
  std::vector<std::string> detectors;  ///< names as on the command line, all different; at least
                                       ///< one. Whether they exist is the registry's business.
};

/// @throws InputError, one sentence: file, path of the field, value, what is allowed
Suite load_suite(const std::filesystem::path& file);

}  // namespace contactcheck
