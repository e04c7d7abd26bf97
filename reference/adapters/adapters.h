// The functions through which register.cpp gets the detectors of each adapted library. The
// library's types stay in its .cpp file.
#pragma once

#include <string>
#include <vector>

#include "core/detect/registry.h"

namespace contactcheck::adapters {

/// The detectors made of one library.
struct Adapter {
  std::string library;  ///< first word of its detectors' names
  std::string version;  ///< of the library
  std::vector<DetectorInfo> detectors;
};

Adapter bullet_gimpact_adapter();
Adapter bullet_soft_adapter();
Adapter embree_adapter();
Adapter fcl_adapter();
Adapter libccd_adapter();

/// Another of FCL's, in a file of its own.
DetectorInfo fcl_ccd_detector();

/// Detectors of elementary impacts.
ImpactDetectorInfo bullet_impact_detector();
ImpactDetectorInfo fcl_impact_detector();

}  // namespace contactcheck::adapters
