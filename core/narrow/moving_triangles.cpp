#include "core/narrow/moving_triangles.h"

#include <algorithm>
#include <cmath>

namespace contactcheck {
namespace {

// Lowest and highest of three.
struct Extremes {
  double low, high;
};

Extremes extremes_along(const Vec3& normal, const Vec3* corners) {
  const double a = normal.dot(corners[0]), b = normal.dot(corners[1]), c = normal.dot(corners[2]);
  return {std::min({a, b, c}), std::max({a, b, c})};
}

}  // namespace

RelativeCorners::RelativeCorners(const MovingTriangle& first, const MovingTriangle& second) {
  const auto fill = [&](const MovingTriangle& of, std::array<Vec3, 6>& out) {
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = *of.start[i] - *second.start[0];
      out[3 + i] = *of.end[i] - *second.end[0];
      farthest =
          std::max({farthest, out[i].cwiseAbs().maxCoeff(), out[3 + i].cwiseAbs().maxCoeff()});
    }
  };
  fill(first, p);
  fill(second, q);
}

// Claim: the gap is wrong by at most its error and one rounding of itself, so that it is above 0
// where its distance is computed as larger than its error.
//
// Notation: u = 2^-53; n is the direction, exact or not, N the sum of its |coordinates|; d a
// corner, D the largest |coordinate| of corners. Errors are counted to first order in u.
//   * d rounds by u D per coordinate, as a difference of doubles: n.d by u N D.
//   * The three products of n.d round by u N D together, each of the two sums by u N D at most:
//     with d that makes 4 u N D.
//   * A gap is the difference of two n.d: 8 u N D. Its own rounding is monotone: the computed one
//     is not larger than a number that the exact difference of the two is not larger than.
//   * 9 u N D is taken, for the error is rounded as well, and 2^-1000 for products that underflow.
Gap gap_along(const Vec3& normal, const RelativeCorners& corners) {
  const auto at = [&](std::size_t first) {
    const Extremes p = extremes_along(normal, &corners.p[first]);
    const Extremes q = extremes_along(normal, &corners.q[first]);
    return std::array{p.low - q.high, q.low - p.high};
  };
  const auto start = at(0), end = at(3);
  Gap out;
  out.distance = std::max(std::min(start[0], end[0]), std::min(start[1], end[1]));
  out.error = 9 * 0x1p-53 * normal.cwiseAbs().sum() * corners.farthest + 0x1p-1000;
  return out;
}

// What lies on one side of a plane at both ends, and what on the other, stays there: n.x at t is a
// weighted mean of both ends, as in MovingBox.
bool separated(const MovingTriangle& p, const MovingTriangle& q) {
  if (separated(p.box, q.box)) return true;
  const RelativeCorners corners(p, q);
  // Products of three lengths must not overflow: a corner at NaN would be passed over. Below this
  // nothing does. False for NaN and infinity, too.
  constexpr double kLargest = 0x1p300;
  if (!(corners.farthest <= kLargest)) return false;
  for (const std::array<Vec3, 6>* of : {&corners.q, &corners.p}) {
    const Vec3 normal = ((*of)[1] - (*of)[0]).cross((*of)[2] - (*of)[0]);
    const Gap gap = gap_along(normal, corners);
    if (gap.distance > gap.error) return true;
  }
  return false;
}

}  // namespace contactcheck
