#include "core/types/local_origin.h"

#include <cmath>

#include "core/types/check.h"

namespace contactcheck {
namespace {

[[noreturn]] void refuse() {
  throw RefusedInput(
      "a coordinate lies more than 2^40 (1.1e12) metres from the local origin, the centre of the "
      "scene: beyond what is computed in single precision");
}

}  // namespace

Vec3 local_origin(const Frame& frame) {
  Aabb box;
  for (const BodyState& body : frame.bodies)
    for (const Vec3& node : body.nodes) box.extend(node);
  if (box.empty()) return Vec3::Zero();
  return box.center();
}

void round_to_local(std::span<const Vec3> points, const Vec3& origin, std::span<Vec3f> out) {
  CONTACTCHECK_INVARIANT(points.size() == out.size(), "one place per point");
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      // Before the conversion: beyond the range of floats it is not defined. Refuses NaN, too.
      if (!(std::abs(points[i][k] - origin[k]) <= kSingleLimit)) refuse();
      out[i][k] = local_value(points[i][k], origin[k]);
    }
}

}  // namespace contactcheck
