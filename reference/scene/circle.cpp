#include "reference/scene/circle.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/types/check.h"

namespace contactcheck {
namespace {

// Taylor's series for 0 <= angle <= pi/4 in a fixed order of operations; the first term left out,
// angle^19 / 19!, is below 1e-19.
CirclePoint small_angle(double angle) {
  const double square = angle * angle;
  double cosine = 1.0, sine = 1.0;
  for (int term = 18; term >= 2; term -= 2) cosine = 1.0 - square / (term * (term - 1)) * cosine;
  for (int term = 19; term >= 3; term -= 2) sine = 1.0 - square / (term * (term - 1)) * sine;
  return {cosine, angle * sine};
}

}  // namespace

CirclePoint circle_point(std::size_t k, std::size_t n) {
  CONTACTCHECK_INVARIANT(n > 0, "a circle has at least one step");
  const std::size_t eighths = 8 * (k % n);
  const std::size_t octant = eighths / n, rest = eighths % n;
  // Odd octants run backwards from the next quarter, so that mirrored points get mirrored bits.
  const std::size_t part = octant % 2 == 0 ? rest : n - rest;
  const double fraction = static_cast<double>(part) / static_cast<double>(n);
  // On a diagonal the series would give two values an ulp apart.
  const double diagonal = std::sqrt(0.5);
  CirclePoint p =
      part == n ? CirclePoint{diagonal, diagonal} : small_angle(0.25 * std::numbers::pi * fraction);
  if (octant % 4 == 1 || octant % 4 == 2) std::swap(p.cosine, p.sine);
  if (octant >= 2 && octant <= 5) p.cosine = -p.cosine;
  if (octant >= 4) p.sine = -p.sine;
  return p;
}

}  // namespace contactcheck
