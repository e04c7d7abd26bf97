// Plug-ins that the command line names: shared libraries and commands (reference/plugin).
#pragma once

#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/plugin/plugin.h"
#include "reference/suite/job.h"

namespace contactcheck::cli {

/// The detectors of a command line, with everything needed to make them.
struct OwnDetectors {
  std::vector<std::string> names;  ///< as the catalogue parses them, in the order they were given
  std::vector<plugin::Plugin> plugins;  ///< plug-ins that these or other names may refer to
  DetectorCatalog catalog;              ///< of the program and of these

  /// The plug-ins as strings for workers.
  std::vector<std::string> records() const;
  std::vector<std::string> ids() const;  ///< theirs
};

/// True if `text` ("./libmine.so:leaf=8") names a library's file and not a detector's id: before
/// the first ':' it contains '/' or ends with ".so".
bool names_library(const std::string& text);

/// Examines every library among `detectors` and every command, each once, within the limits of
/// `settings`, before anything else runs.
/// @throws InputError if one cannot be used, or two have the same id
OwnDetectors load_own_detectors(const std::vector<std::string>& detectors,
                                const std::vector<std::string>& commands,
                                const suite::RunSettings& settings, const DetectorCatalog& catalog);

}  // namespace contactcheck::cli
