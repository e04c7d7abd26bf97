// Why the filters are right.
//
// Let e = 2^-53, so that fl(s) = s (1 + d), |d| <= e, for a sum or difference (which never
// underflows: a denormal sum is exact), and fl(p) = p (1 + d) + n, |n| <= 2^-1075, for a product.
// Let X, Y, Z be the largest computed |differences| per axis.
//
// orient3d. The determinant is a sum of six products of three differences, one of each axis.
//   * Each true difference is its computed value times (1 + d): all six products together differ
//     from those of the computed differences by at most 6 * 3 e XYZ = 18 e XYZ.
//   * A minor such as uy*vz - uz*vy: two products of at most YZ, each wrong by e YZ, and their
//     difference, at most 2 YZ, rounded once: 4 e YZ in all. Times wx: 4 e XYZ, plus e * 2 XYZ for
//     the rounding of the product: 6 e XYZ. Three of them: 18 e XYZ.
//   * The sums: at most 4 XYZ, then 6 XYZ, each rounded once: 10 e XYZ.
//   In all 46 e XYZ to first order. The terms of higher order are below 200 e^2 XYZ, and the three
//   roundings of the bound itself make it smaller by at most 3 e of it; both are far below e XYZ.
//   * Underflow: a minor may be wrong by another 2 n, each product with w by another n: in all
//     3 (2 n max(X, Y, Z) + n) and roundings thereof, below 2^-1072 (2^300 + 1) < 2^-771 as the
//     differences are at most 2^300. The bound is at least 2^-700, so e XYZ >= 2^-706 covers it.
//     (Underflow within the bound: if fl(XY) underflowed, the bound would be below
//     2^-1022 * 2^300 and fail its test.)
//   * Overflow: differences of at most 2^300 give sums below 2^903. A difference that overflowed is
//     infinite and fails the test; NaN fails every comparison that would return a sign.
//   So 48 e XYZ is an upper bound of the error.
//
// orient2d, the same: 2 * 2 e XY from the differences, 2 e XY from the products and 2 e XY from
// their difference, 8 e XY to first order; underflow adds 2 n = 2^-1074. 10 e XY is a bound. Where
// a difference or XY overflows the bound is infinite or NaN and no sign passes; where XY is finite
// both products are, and if their difference overflows, its sign is right.
//
// Exact path. Scaling one axis by a power of two scales the determinant and keeps its sign. So
// every axis is divided by the lowest set bit of its coordinates, which makes them integers: short
// ones for coordinates of like size, up to 2098 bits for 5e-324 with 1.8e308.

#include "core/narrow/predicates.h"

#include <array>
#include <limits>

#include "core/narrow/exact_integer.h"

namespace contactcheck {
namespace {

thread_local std::size_t exact_calls = 0;

/// Differences of `count` coordinates from the first one, on a common integer scale.
template <std::size_t count>
std::array<ExactInteger, count - 1> exact_differences(const std::array<double, count>& values) {
  int exponent = std::numeric_limits<int>::max();
  for (double value : values)
    if (value != 0) exponent = std::min(exponent, lowest_bit_exponent(value));
  const ExactInteger origin = ExactInteger::from_double(values[0], exponent);
  std::array<ExactInteger, count - 1> differences;
  for (std::size_t i = 1; i < count; ++i)
    differences[i - 1] = ExactInteger::from_double(values[i], exponent) - origin;
  return differences;
}

}  // namespace

int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ++exact_calls;
  if (a == b || a == c || a == d || b == c || b == d || c == d) return 0;
  const auto x = exact_differences<4>({a.x(), b.x(), c.x(), d.x()});
  const auto y = exact_differences<4>({a.y(), b.y(), c.y(), d.y()});
  const auto z = exact_differences<4>({a.z(), b.z(), c.z(), d.z()});
  const ExactInteger determinant = (y[0] * z[1] - z[0] * y[1]) * x[2] +
                                   (z[0] * x[1] - x[0] * z[1]) * y[2] +
                                   (x[0] * y[1] - y[0] * x[1]) * z[2];
  return determinant.sign();
}

int orient2d_exact(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  ++exact_calls;
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  const auto x = exact_differences<3>({a[first], b[first], c[first]});
  const auto y = exact_differences<3>({a[second], b[second], c[second]});
  return (x[0] * y[1] - y[0] * x[1]).sign();
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0 && orient2d(a, b, c, 2) == 0;
}

std::size_t exact_predicate_calls() { return exact_calls; }
void reset_exact_predicate_calls() { exact_calls = 0; }

}  // namespace contactcheck
