#include "reference/adapters/register.h"

#include <Eigen/Core>

#include "reference/adapters/fcl_adapter.h"

namespace contactcheck {
namespace {

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace

void register_reference_detectors(DetectorCatalog& catalog) { register_fcl_detectors(catalog); }

std::map<std::string, std::string> library_versions() {
  return {{"eigen", eigen_version()}, {"fcl", fcl_version()}};
}

}  // namespace contactcheck
