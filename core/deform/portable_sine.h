// Sine and cosine with the same bits on every machine: sums, products, quotients and the exact
// remainder alone. glibc's differ between processors with and without fused multiply-add.
#pragma once

#include <cmath>

namespace contactcheck {

struct SineCosine {
  double sine = 0.0, cosine = 1.0;
};

/// Within 2^-50 of the true values; exact at multiples of 90. @pre `degrees` is finite
inline SineCosine portable_sine_cosine(double degrees) {
  const double turned = std::remainder(degrees, 360.0);  // exact, in [-180, 180]
  const int quarter = static_cast<int>(turned / 90.0 + (turned < 0.0 ? -0.5 : 0.5));
  constexpr double kRadiansPerDegree = 0x1.1df46a2529d39p-6;
  const double x = (turned - 90.0 * quarter) * kRadiansPerDegree;  // within pi / 4
  const double square = x * x;
  // Taylor series from the smallest term on: the first one left out is below 2^-56.
  double sine = 0.0, cosine = 0.0;
  for (int n = 16; n > 0; n -= 2) {
    sine = (1.0 - sine) * square / static_cast<double>(n * (n + 1));
    cosine = (1.0 - cosine) * square / static_cast<double>(n * (n - 1));
  }
  sine = x - x * sine;
  cosine = 1.0 - cosine;
  switch (quarter) {
    case 1:
      return {cosine, -sine};
    case -1:
      return {-cosine, sine};
    case 0:
      return {sine, cosine};
    default:
      return {-sine, -cosine};
  }
}

}  // namespace contactcheck
