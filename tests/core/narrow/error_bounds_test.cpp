// How much of the proved error bounds of the filters (predicates.cpp) a search for large errors
// sees. A bound that is half as wide does not hold.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/narrow/predicates.h"
#include "tests/support/observed_error.h"
#include "tests/support/random_triangles.h"
#include "tests/support/wide.h"

namespace contactcheck {
namespace {

using test::TriangleSource;
using test::Wide;

template <std::size_t points, std::size_t axes>
using Points = std::array<std::array<double, axes>, points>;

// What orient3d and orient2d evaluate, of differences from the first point; in Wide without an
// error that would matter.
template <typename Real, std::size_t points, std::size_t axes>
Real determinant(const Points<points, axes>& p) {
  std::array<std::array<Real, axes>, points> from_a;
  for (std::size_t i = 1; i < points; ++i)
    for (std::size_t k = 0; k < axes; ++k) from_a[i][k] = Real(p[i][k]) - Real(p[0][k]);
  const auto &u = from_a[1], &v = from_a[2];
  if constexpr (axes == 2) {
    return u[0] * v[1] - u[1] * v[0];
  } else {
    const auto& w = from_a[3];
    return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
           (u[0] * v[1] - u[1] * v[0]) * w[2];
  }
}

template <std::size_t points, std::size_t axes>
double error_over_bound(const Points<points, axes>& p, double factor) {
  double bound = factor;
  for (std::size_t k = 0; k < axes; ++k) {
    double largest = 0.0;
    for (std::size_t i = 1; i < points; ++i)
      largest = std::max(largest, std::abs(p[i][k] - p[0][k]));
    bound *= largest;
  }
  const Wide error = Wide(determinant<double>(p)) - determinant<Wide>(p);
  return std::abs(static_cast<double>(error)) / bound;
}

template <std::size_t points, std::size_t axes>
double largest_error(std::uint64_t seed, double factor, int starts, int steps) {
  using P = Points<points, axes>;
  TriangleSource random(seed);
  // Near corners of a cube about the first point: all products are large, and just above a power of
  // two, where rounding errors are largest against the number.
  const auto make = [&] {
    P p;
    for (std::size_t i = 0; i < points; ++i)
      for (double& x : p[i])
        x = (i == 0 ? 0 : 2 * random.below(2) - 1) + std::ldexp(random.unit(), -random.below(40));
    return p;
  };
  const auto change = [&](P& p) {
    double& x = p[random.below(points)][random.below(axes)];
    x += random.unit() * std::ldexp(1.0, -random.below(54));
  };
  return test::climb(starts, steps, make, change,
                     [&](const P& p) { return error_over_bound(p, factor); });
}

TEST(ErrorBounds, OfOrient3dIsReachedByMoreThanHalf) {
  test::report_observed_error("orient3d", largest_error<4, 3>(31, kOrient3dErrorFactor, 60, 30000),
                              0.5);
}

TEST(ErrorBounds, OfOrient2dIsReachedByMoreThanHalf) {
  test::report_observed_error("orient2d", largest_error<3, 2>(32, kOrient2dErrorFactor, 100, 20000),
                              0.5);
}

}  // namespace
}  // namespace contactcheck
