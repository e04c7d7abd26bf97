// Seeded pairs of triangles at the ends of the range of doubles: the largest finite numbers,
// denormal ones, and both in one pair. Free, in one plane, sharing corners, and one ulp off.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "tests/support/random_triangles.h"

namespace contactcheck::test {

inline constexpr double kLargestDouble = std::numeric_limits<double>::max();
inline constexpr double kSmallestDouble = std::numeric_limits<double>::denorm_min();

enum class RangeEnd { kLargest, kDenormal, kBoth };

using TrianglePair = std::pair<TrianglePoints, TrianglePoints>;

class RangeEndSource {
 public:
  RangeEndSource(std::uint64_t seed, RangeEnd end) : random_(seed), end_(end) {}

  TrianglePair free_pair() { return {triangle(), triangle()}; }

  /// One or two corners in common, in any order, or, half of the time, one of them an ulp off.
  TrianglePair sharing_pair() {
    TrianglePair pair = free_pair();
    const int shared = 1 + random_.below(2), turn = random_.below(3);
    for (int i = 0; i < shared; ++i) pair.second[index(i + turn)] = pair.first[index(i)];
    if (random_.below(2) == 0) nudge(pair.second[index(turn)]);
    return pair;
  }

  /// All in one plane whose equation is exact at any magnitude: a coordinate is constant, or that
  /// of another axis, or its negative. Half of the time one coordinate is then an ulp off.
  TrianglePair flat_pair() {
    TrianglePair pair = free_pair();
    const int axis = random_.below(3), kind = random_.below(3);
    const double constant = coordinate();
    for (TrianglePoints* t : {&pair.first, &pair.second})
      for (Vec3& c : *t) {
        const double other = c[(axis + 1) % 3];
        c[axis] = kind == 0 ? constant : kind == 1 ? other : -other;
      }
    return half_nudged(pair);
  }

  /// The second triangle's corners are small integer combinations of the first one's edges and a
  /// third direction, without rounding: on corners, edges, in the plane, and off it. Half of the
  /// time one coordinate is then an ulp off.
  TrianglePair lattice_pair() {
    const Lattice lattice = random_lattice();
    const Vec3 origin = step(lattice, 0);
    const Vec3 u = step(lattice, 1), v = step(lattice, 1), w = step(lattice, 1);
    TrianglePair pair;
    pair.first = {origin, origin + u, origin + v};
    for (Vec3& c : pair.second) {
      c = origin + (random_.below(4) - 1) * u;
      c += (random_.below(4) - 1) * v + (random_.below(3) - 1) * w;
    }
    for (TrianglePoints* t : {&pair.first, &pair.second})
      for (Vec3& c : *t)
        for (int axis = 0; axis < 3; ++axis) c[axis] = std::ldexp(c[axis], lattice.unit[axis]);
    return half_nudged(pair);
  }

 private:
  // A sum of a lattice pair is at most 3.5 times 2^bits, the origin's: below 2^1024 in the largest
  // unit, and below 2^53, so no rounding, in all of them. Where there are 51 bits of the denormal
  // unit, the smallest normal numbers are among the denormal ones.
  static constexpr int kLargestUnit = 974, kDenormalUnit = -1074, kOrdinaryUnit = -48;

  static std::size_t index(int i) { return static_cast<std::size_t>(i % 3); }

  /// An integer of up to `bits` bits, with either sign.
  double whole(int bits) { return std::trunc(std::ldexp(random_.unit(), bits)); }
  /// Or one of the smallest normal numbers.
  double denormal() { return std::ldexp(whole(1 + random_.below(53)), kDenormalUnit); }
  /// From 1.3e300 on.
  double large() {
    const double sign = random_.below(2) == 0 ? 1.0 : -1.0;
    if (random_.below(8) == 0) return sign * kLargestDouble;
    const double mantissa = 1.0 + std::ldexp(std::abs(whole(52)), -52);
    return sign * std::min(std::ldexp(mantissa, 997 + random_.below(27)), kLargestDouble);
  }
  /// So few values that points agree in many, and the smallest difference decides.
  double extreme() {
    const double values[] = {0.0, kSmallestDouble, 3 * kSmallestDouble, kLargestDouble,
                             std::nextafter(kLargestDouble, 0.0)};
    return (random_.below(2) == 0 ? 1.0 : -1.0) * values[random_.below(5)];
  }

  double coordinate() {
    if (end_ == RangeEnd::kLargest) return large();
    if (end_ == RangeEnd::kDenormal) return denormal();
    const int kind = random_.below(4);
    return kind == 0 ? large() : kind == 1 ? denormal() : extreme();
  }
  Vec3 point() {
    const double x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
  }
  TrianglePoints triangle() { return {point(), point(), point()}; }

  /// Per axis: the binary exponent of the unit, and how many bits the origin has in it.
  struct Lattice {
    int unit[3], bits[3];
  };
  int unit() {
    if (end_ == RangeEnd::kLargest) return kLargestUnit;
    if (end_ == RangeEnd::kDenormal) return kDenormalUnit;
    const int units[] = {kLargestUnit, kDenormalUnit, kOrdinaryUnit};
    return units[random_.below(3)];
  }
  Lattice random_lattice() {
    Lattice out;
    for (int axis = 0; axis < 3; ++axis) {
      out.unit[axis] = unit();
      if (out.unit[axis] != kDenormalUnit)
        out.bits[axis] = 40 + random_.below(9);
      else
        out.bits[axis] = random_.below(2) == 0 ? 51 : 1 + random_.below(51);
    }
    return out;
  }
  Vec3 step(const Lattice& lattice, int shorter) {
    Vec3 out;
    for (int axis = 0; axis < 3; ++axis) out[axis] = whole(lattice.bits[axis] - shorter);
    return out;
  }

  /// One coordinate by one ulp, towards zero: the other way may be infinite.
  void nudge(Vec3& point) {
    double& value = point[random_.below(3)];
    value = value == 0.0 ? kSmallestDouble : std::nextafter(value, 0.0);
  }
  TrianglePair half_nudged(TrianglePair pair) {
    if (random_.below(2) == 0) return pair;
    nudge((random_.below(2) == 0 ? pair.first : pair.second)[index(random_.below(3))]);
    return pair;
  }

  TriangleSource random_;
  RangeEnd end_;
};

}  // namespace contactcheck::test
