// The detectors of other libraries.
#pragma once

#include <map>
#include <string>

#include "core/detect/registry.h"

namespace contactcheck::adapters {

/// Adds every adapted detector to the catalogue.
void register_reference_detectors(DetectorCatalog& catalog);

/// A catalogue of all detectors of this program: core's and the adapted ones.
DetectorCatalog standard_catalog();

/// Versions of the libraries that detectors are made of, by library: "fcl" -> "0.7.0".
std::map<std::string, std::string> library_versions();

/// The library of a detector, given its name; "contactcheck" for our own detectors.
std::string library_of(const std::string& detector);

}  // namespace contactcheck::adapters
