#include "reference/adapters/register.h"

#include <Eigen/Core>

#include "reference/adapters/bullet_soft_adapter.h"
#include "reference/adapters/embree_adapter.h"
#include "reference/adapters/fcl_adapter.h"
#include "reference/adapters/gimpact_adapter.h"
#include "reference/adapters/libccd_adapter.h"

namespace contactcheck {
namespace {

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace

void register_reference_detectors(DetectorCatalog& catalog) {
  register_fcl_detectors(catalog);
  register_embree_detector(catalog);
  register_bullet_soft_detectors(catalog);
  register_gimpact_detector(catalog);
  register_libccd_detectors(catalog);
}

DetectorCatalog standard_catalog() {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  register_reference_detectors(catalog);
  return catalog;
}

std::map<std::string, std::string> library_versions() {
  return {{"bullet", bullet_version()},
          {"eigen", eigen_version()},
          {"embree", embree_version()},
          {"fcl", fcl_version()},
          {"libccd", libccd_version()}};
}

std::string library_of(const std::string& detector) {
  const std::string word = detector.substr(0, detector.find_first_of("-+:"));
  const bool foreign = word == "bullet" || word == "embree" || word == "fcl" || word == "libccd";
  return foreign ? word : "contactcheck";
}

}  // namespace contactcheck
