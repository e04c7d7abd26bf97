// What `ab` sets side by side: two builds of this program, or two builds of a plug-in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/cli/commands.h"

namespace contactcheck {

/// How one side is run.
struct AbSide {
  std::string name;                    ///< "base" or "head"
  std::filesystem::path program;       ///< absolute
  std::vector<std::string> detectors;  ///< of its command line
};

/// Base and head. @throws InputError: no program that can be run, no library that can be used, a
/// program against a library, libraries whose detectors have different names
std::vector<AbSide> ab_sides(const AbArguments& arguments, const DetectorCatalog& catalog);

}  // namespace contactcheck
