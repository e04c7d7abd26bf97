#pragma once

#include <span>

#include "core/types/vec3.h"

namespace contactcheck::oracle {

/// The smallest box that holds the points; empty without points.
inline Aabb box_of(std::span<const Vec3> points) {
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

}  // namespace contactcheck::oracle
