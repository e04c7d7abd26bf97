#include "reference/view/placement.h"

#include <algorithm>
#include <cmath>

namespace contactcheck {
namespace {

// Below this share of the whole, a frame of its own is shown in a box of its own. At 1/64 a frame
// still has 18 of the 24 bits of a single, and a few pixels on the screen.
constexpr double kSmallestShare = 1.0 / 64.0;

Aabb box_of(const std::vector<std::vector<Vec3>>& bodies) {
  Aabb box;
  for (const std::vector<Vec3>& nodes : bodies)
    for (const Vec3& p : nodes) box.extend(p);
  return box;
}

// Halved first: the extent of a box as large as the doubles is no double.
double half_size(const Aabb& box) {
  return box.empty() ? 0.0 : (0.5 * box.hi - 0.5 * box.lo).maxCoeff();
}

Placement around(const Aabb& box) {
  const double half = half_size(box);
  if (!(half > 0.0)) return {box.empty() ? Vec3(Vec3::Zero()) : box.center(), 1.0};
  // The next power of two, within the doubles; dividing by it rounds nothing that a single keeps.
  const int exponent = std::min(std::ilogb(half) + 1, 1023);
  return {box.center(), std::ldexp(1.0, exponent)};
}

}  // namespace

std::vector<Placement> view_placements(const FrameNodes& frames) {
  Aabb whole;
  std::vector<Aabb> boxes;
  for (const auto& bodies : frames) {
    boxes.push_back(box_of(bodies));
    if (!boxes.back().empty()) whole.extend(boxes.back());
  }
  const auto small = [&](const Aabb& box) {
    return half_size(box) < kSmallestShare * half_size(whole);
  };
  if (std::none_of(boxes.begin(), boxes.end(), small)) return {around(whole)};
  std::vector<Placement> out;
  for (const Aabb& box : boxes) out.push_back(around(box));
  return out;
}

}  // namespace contactcheck
