// The family in the reading that is exact: safe bounds, triangles tested.
#pragma once

#include "core/detect/ffd_config.h"

namespace contactcheck::test {

/// Of several levels of spheres, four to each above.
inline FfdConfig safe_config(CellVolume volume, int sphere_levels) {
  FfdConfig config;
  config.volume = volume;
  config.sphere_levels = sphere_levels;
  config.spheres = 4;
  config.element = ElementTest::kTriangle;
  config.bounds = BoundsReading::kSafe;
  return config;
}

/// The box about the same centre with `share` of its size.
template <typename T>
AabbOf<T> shrunk(const AabbOf<T>& box, T share) {
  if (share == T(1)) return box;
  const Vec3Of<T> center = box.center();
  return {center + (box.lo - center) * share, center + (box.hi - center) * share};
}

}  // namespace contactcheck::test
