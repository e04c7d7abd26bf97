// What a detector says about itself, for people.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/plugin/plugin.h"

namespace contactcheck::cli {

/// Lines of at most `width` characters (longer only where one word is): summary, declared semantics
/// with the options at their defaults, and the options with what is allowed.
std::string detector_sheet(const DetectorInfo& info, std::size_t width);

/// The same with the options of `spec`, under its name. @pre spec is one of this detector
std::string detector_sheet(const DetectorInfo& info, const DetectorSpec& spec, std::size_t width);

/// The same of a detector from outside, with where it comes from, its version and what it is given,
/// as it declared them with its options at their defaults: nothing of it is loaded or started.
/// `options`: as its entry in the catalogue has them.
std::string plugin_sheet(const plugin::Plugin& plugin, const std::vector<OptionInfo>& options,
                         const DetectorSpec& spec, std::size_t width);

/// The same for a detector of queries of moving elements.
std::string impact_sheet(const ImpactDetectorInfo& info, const DetectorSpec& spec,
                         std::size_t width);

}  // namespace contactcheck::cli
