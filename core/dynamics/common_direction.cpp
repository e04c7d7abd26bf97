#include "core/dynamics/common_direction.h"

#include "core/dynamics/unit_vector.h"

namespace contactcheck {

void agree_on_directions(const Directions& common, std::vector<ContactPoint>& points) {
  constexpr double kCosine = 0.5;
  for (ContactPoint& point : points) {
    const auto at = common.find({point.body_a, point.body_b});
    if (at == common.end()) continue;
    const Vec3 direction = unit_or_zero(at->second);
    if (direction.isZero(0.0) || ordered_dot(direction, point.normal) >= kCosine) continue;
    point.normal = direction;
  }
}

}  // namespace contactcheck
