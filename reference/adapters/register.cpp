#include "reference/adapters/register.h"

#include <Eigen/Core>

#include "reference/adapters/adapters.h"

namespace contactcheck::adapters {
namespace {

std::vector<Adapter> adapters() {
  return {
      fcl_adapter(),             //
      embree_adapter(),          //
      bullet_soft_adapter(),     //
      bullet_gimpact_adapter(),  //
      libccd_adapter(),          //
  };
}

}  // namespace

void register_reference_detectors(DetectorCatalog& catalog) {
  for (const Adapter& adapter : adapters())
    for (const DetectorInfo& detector : adapter.detectors) catalog.add(detector);
  catalog.add(fcl_ccd_detector());
  catalog.add(fcl_impact_detector());
  catalog.add(bullet_impact_detector());
}

DetectorCatalog standard_catalog() {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  register_reference_detectors(catalog);
  return catalog;
}

std::map<std::string, std::string> library_versions() {
  std::map<std::string, std::string> out;
  for (const Adapter& adapter : adapters()) out[adapter.library] = adapter.version;
  out["eigen"] = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                 "." + std::to_string(EIGEN_MINOR_VERSION);
  return out;
}

std::string library_of(const std::string& detector) {
  const std::string word = detector.substr(0, detector.find_first_of("-+:"));
  for (const Adapter& adapter : adapters())
    if (adapter.library == word) return word;
  return "contactcheck";
}

}  // namespace contactcheck::adapters
