// Plug-ins that the command line names: shared libraries and commands (reference/plugin).
#pragma once

#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/plugin/plugin.h"
#include "reference/suite/job.h"

namespace contactcheck::cli {

/// The detectors of a command line, with all that it takes to make them.
struct OwnDetectors {
  std::vector<std::string> names;  ///< as the catalogue parses them, in the order they were given
  std::vector<plugin::Plugin> plugins;  ///< those from outside that they or others may name
  DetectorCatalog catalog;              ///< of the program and of these

  /// The plug-ins as workers are handed them.
  std::vector<std::string> records() const;
  std::vector<std::string> ids() const;  ///< theirs
};

/// True when `text` ("./libmine.so:leaf=8") names a library's file and no detector's id: before the
/// first ':' there is a '/' or, at the end, ".so".
bool names_library(const std::string& text);

/// Examines every library among `detectors` and every command, each once, within the limits of
/// `settings`; nothing else runs before.
/// @throws InputError: one cannot be used, or two call themselves the same
OwnDetectors load_own_detectors(const std::vector<std::string>& detectors,
                                const std::vector<std::string>& commands,
                                const suite::RunSettings& settings, const DetectorCatalog& catalog);

}  // namespace contactcheck::cli
