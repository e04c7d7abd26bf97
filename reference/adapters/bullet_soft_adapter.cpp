#include "reference/adapters/bullet_soft_adapter.h"

#include <LinearMath/btScalar.h>

#include "core/detect/option_info.h"
#include "reference/adapters/bullet_cl.h"
#include "reference/adapters/bullet_vf.h"

namespace contactcheck {
namespace {

std::vector<OptionInfo> common_options() {
  return {numeric_option("margin", "0.001", 0.0, 1.0, false, "metres around each body"),
          numeric_option("scale", "0", 0.0, 1e6, false,
                         "world units per metre; 0: as the smallest triangles need")};
}

DetectorInfo vf_info() {
  DetectorInfo info;
  info.id = "bullet-vf";
  info.summary = "Bullet's soft bodies: vertices nearer to faces than the margins";
  info.options = common_options();
  info.make = [](const Options& options) {
    return make_bullet_vf(number_option(options, "margin"), number_option(options, "scale"));
  };
  return info;
}

DetectorInfo cl_info() {
  DetectorInfo info;
  info.id = "bullet-cl";
  info.summary = "Bullet's soft bodies: convex hulls of clusters of vertices";
  info.options = common_options();
  info.options.push_back(
      numeric_option("k", "64", 1.0, 4096.0, true, "at most so many clusters per body"));
  info.make = [](const Options& options) {
    return make_bullet_cl(static_cast<int>(number_option(options, "k")),
                          number_option(options, "margin"), number_option(options, "scale"));
  };
  return info;
}

}  // namespace

void register_bullet_soft_detectors(DetectorCatalog& catalog) {
  catalog.add(vf_info());
  catalog.add(cl_info());
}

std::string bullet_version() {
  const int version = btGetVersion();
  return std::to_string(version / 100) + "." + std::to_string(version % 100) +
         (sizeof(btScalar) == sizeof(float) ? " float" : " double");
}

}  // namespace contactcheck
