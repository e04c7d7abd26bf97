// The detectors of other libraries.
#pragma once

#include <map>
#include <string>

#include "core/detect/registry.h"

namespace contactcheck::adapters {

/// Adds every adapted detector to the catalogue.
void register_reference_detectors(DetectorCatalog& catalog);

/// Every detector of this program: core's and the adapted ones.
DetectorCatalog standard_catalog();

/// Versions of the libraries that detectors are made of, by library: "fcl" -> "0.7.0".
std::map<std::string, std::string> library_versions();

/// The one of these that a detector is made of, by its name; "contactcheck" for our own.
std::string library_of(const std::string& detector);

}  // namespace contactcheck::adapters
