// Why the filter is right.
//
// Let e be the relative error of an operation: 2^-53 of doubles, 2^-103 of double-doubles. Let X,
// Y, Z be the extents, per axis, of all eight places: no difference of two points at any time is
// larger. (The computed extent may be smaller by a share of 2^-53; the constants have room.)
//
// A part [l, r] of the step, with l and r multiples of 2^-50. The places of the points there,
// relative to point 0, are q(l) = (1 - l) q(0) + l q(1), likewise q(r), with q(0) and q(1) rounded
// differences.
//   * Of q(0) and q(1) e X each, so e X in q(l). Of two products e X together, as their weights add
//     up to 1; of the sum e X. In all 3 e X, to first order. (l and 1 - l are exact.)
//   * A difference of two of them: 2 * 3 e X and its own rounding e X: 7 e X.
//
// f, the determinant of q1, q2, q3, in the form sum c_i s^(3-i) t^i on [l, r] (impact_exact.cpp).
// Each c_i is a sum of at most 18 products of three, each at most X Y Z.
//   * A product's factors have 3 e of their extent each: 9 e X Y Z. It is rounded twice, and passes
//     through at most five sums: the difference and the sum in the normal's coefficients, two in
//     the scalar product, one between scalar products: 7 e of it.
//   * 18 (9 + 7) e = 288 e X Y Z, to first order.
//   So kVolume = 320 times e X Y Z is a bound.
//
// A component of (b - a) x (c - a) in such a form on [l, r]: at most four products of two.
//   * Factors have 7 e of their extent: 14 e X Y. One product, a difference and a sum: 3 e.
//   * 4 (14 + 3) e = 68 e X Y. kArea = 80 times e X Y is a bound.
//
// The scalar product of a direction d with the difference of a point of one element and one of the
// other: 7 e X |dx| and so on from the difference, at most 3 e of each product. kLength = 12 times
// e (X |dx| + Y |dy| + Z |dz|) is a bound. (Directions are always of doubles.)
//
// Each constant leaves a tenth of its bound for what follows, which is far below that: terms of
// higher order, the rounding of the bound itself, and underflow: at most 2^-1074 in a place, in a
// product, or in a low word of a double-double. Extents are at most 2^300, so that is below
//   * 2^-465 in f, where a place is a factor beside two extents, at most 3 * 18 times and in 18
//     products: bounds of f that are used are at least 2^-400
//   * 2^-765 in the other two, where it has one factor beside it: bounds of at least 2^-700
// No sum exceeds 2^905.
//
// What follows from signs.
//   * A direction with positive scalar products for all points at l and at r separates the elements
//     throughout [l, r]: in between, differences are convex combinations of those at the ends.
//   * All c_i of f of one sign: the four points are not coplanar within [l, r].
//   * In a projection, the vertex strictly outside the triangle, or an edge strictly on one side of
//     the other, throughout: apart.
//   * f of different signs at l and r, with one sign change in the c_i whatever the sign of those
//     that are not certain: one root within. If the vertex is strictly inside the projected
//     triangle, or each projected edge has its ends strictly on both sides of the other,
//     throughout: contact at that root, and at no other time of [l, r].
#include "core/narrow/impact_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/narrow/double_double.h"

namespace contactcheck {
namespace {

constexpr double kVolume = 320, kArea = 80, kLength = 12;
constexpr double kLargestExtent = 0x1p300, kSmallestBound = 0x1p-700,
                 kSmallestVolumeBound = 0x1p-400;
/// Halvings of the step while there may be several roots.
constexpr int kHalvings = 7;
constexpr int kDirections = 5;

/// What one precision offers.
template <typename Real>
struct Precision;
template <>
struct Precision<double> {
  static constexpr double kError = 0x1p-53;
  static double difference(double a, double b) { return a - b; }
  static double leading(double value) { return value; }
};
template <>
struct Precision<DoubleDouble> {
  static constexpr double kError = kDoubleDoubleError;
  static DoubleDouble difference(double a, double b) { return DoubleDouble::sum(a, -b); }
  static double leading(const DoubleDouble& value) { return value.high; }
};

/// The sign where the bound allows to tell it, else 0.
template <typename Real>
int certain_sign(const Real& value, double bound) {
  const double leading = Precision<Real>::leading(value);
  return leading > bound ? 1 : (leading < -bound ? -1 : 0);
}

/// Their sign when all values have the same certain one, else 0.
template <typename Real, std::size_t count>
int common_sign(const std::array<Real, count>& values, double bound) {
  const int sign = certain_sign(values[0], bound);
  for (std::size_t i = 1; i < count; ++i)
    if (certain_sign(values[i], bound) != sign) return 0;
  return sign;
}

template <typename Real>
using VectorOf = std::array<Real, 3>;

template <typename Real>
class Filter {
 public:
  explicit Filter(const ImpactQuery& query) : kind_(query.kind) {
    for (int axis = 0; axis < 3; ++axis) {
      double low = query.start[0][axis], high = low;
      for (const auto* places : {&query.start, &query.end})
        for (const Vec3& place : *places) {
          low = std::min(low, place[axis]);
          high = std::max(high, place[axis]);
        }
      extent_[axis] = high - low;
      for (std::size_t point = 0; point < 4; ++point) {
        start_[point][axis] =
            Precision<Real>::difference(query.start[point][axis], query.start[0][axis]);
        end_[point][axis] = Precision<Real>::difference(query.end[point][axis], query.end[0][axis]);
      }
    }
    const auto [x, y, z] = extent_;
    usable_ = std::max(std::max(x, y), z) <= kLargestExtent;
    volume_bound_ =
        bound_or_nothing(kVolume * Precision<Real>::kError * (x * y * z), kSmallestVolumeBound);
    area_bound_ = {bound_or_nothing(kArea * Precision<Real>::kError * (y * z)),
                   bound_or_nothing(kArea * Precision<Real>::kError * (z * x)),
                   bound_or_nothing(kArea * Precision<Real>::kError * (x * y))};
  }

  /// The interval of a `contact` contains one root of f, its time, and may be wide.
  FilteredImpact decide() {
    if (!usable_) return {};
    direction_ = {0, 0, 0};
    return decide(0, 1, 0);
  }

  /// f at a multiple of 2^-50.
  Real determinant_at(double t) const {
    std::array<Vector, 4> q;
    for (std::size_t point = 1; point < 4; ++point)
      for (std::size_t axis = 0; axis < 3; ++axis) q[point][axis] = place(point, axis, t);
    return (q[1][1] * q[2][2] - q[1][2] * q[2][1]) * q[3][0] +
           (q[1][2] * q[2][0] - q[1][0] * q[2][2]) * q[3][1] +
           (q[1][0] * q[2][1] - q[1][1] * q[2][0]) * q[3][2];
  }
  double volume_bound() const { return volume_bound_; }

 private:
  using Vector = VectorOf<Real>;
  using Quadratic = std::array<Real, 3>;

  /// No value exceeds what is returned for a bound too small to hold.
  static double bound_or_nothing(double bound, double smallest = kSmallestBound) {
    return bound >= smallest ? bound : std::numeric_limits<double>::infinity();
  }

  /// The four points at both ends of a part, relative to point 0.
  struct Part {
    std::array<Vector, 4> start, end;
  };

  Real place(std::size_t point, std::size_t axis, double t) const {
    if (t == 0) return start_[point][axis];
    if (t == 1) return end_[point][axis];
    return start_[point][axis] * Real(1 - t) + end_[point][axis] * Real(t);
  }

  Part part(double from, double to) const {
    Part result;
    for (std::size_t point = 0; point < 4; ++point)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        result.start[point][axis] = place(point, axis, from);
        result.end[point][axis] = place(point, axis, to);
      }
    return result;
  }

  /// Coefficients of f.
  static std::array<Real, 4> determinant(const Part& p) {
    std::array<Vector, 3> normal;  // of q1 and q2, as a form of degree 2
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[0][axis] = p.start[1][u] * p.start[2][v] - p.start[1][v] * p.start[2][u];
      normal[1][axis] = (p.start[1][u] * p.end[2][v] - p.start[1][v] * p.end[2][u]) +
                        (p.end[1][u] * p.start[2][v] - p.end[1][v] * p.start[2][u]);
      normal[2][axis] = p.end[1][u] * p.end[2][v] - p.end[1][v] * p.end[2][u];
    }
    const auto dot = [](const Vector& a, const Vector& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    return {dot(normal[0], p.start[3]), dot(normal[1], p.start[3]) + dot(normal[0], p.end[3]),
            dot(normal[2], p.start[3]) + dot(normal[1], p.end[3]), dot(normal[2], p.end[3])};
  }

  /// Coefficients of component `axis` of (b - a) x (c - a).
  static Quadratic orientation(const Part& p, int a, int b, int c, int axis) {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    const std::size_t u = at((axis + 1) % 3), v = at((axis + 2) % 3);
    const auto difference = [&](const std::array<Vector, 4>& places, int to, std::size_t k) {
      return places[at(to)][k] - places[at(a)][k];
    };
    const Real b0u = difference(p.start, b, u), b0v = difference(p.start, b, v);
    const Real c0u = difference(p.start, c, u), c0v = difference(p.start, c, v);
    const Real b1u = difference(p.end, b, u), b1v = difference(p.end, b, v);
    const Real c1u = difference(p.end, c, u), c1v = difference(p.end, c, v);
    return {b0u * c0v - b0v * c0u, (b0u * c1v - b0v * c1u) + (b1u * c0v - b1v * c0u),
            b1u * c1v - b1v * c1u};
  }

  /// Searches a direction that separates the elements within the part, by Gilbert's steps towards
  /// the point nearest to zero of the hull of all differences at both ends. It starts with the
  /// direction found last.
  bool separated(const Part& p) {
    std::array<std::array<double, 3>, 8> differences;
    std::size_t count = 0;
    const auto add = [&](std::size_t i, std::size_t j) {
      for (const auto* places : {&p.start, &p.end}) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          differences[count][axis] =
              Precision<Real>::leading((*places)[i][axis] - (*places)[j][axis]);
        ++count;
      }
    };
    if (kind_ == ImpactKind::vertex_triangle) {
      for (std::size_t corner = 1; corner < 4; ++corner) add(0, corner);
    } else {
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 2; j < 4; ++j) add(i, j);
    }
    const auto dot = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    std::array<double, 3> nearest = direction_;
    bool in_hull = false;
    if (dot(nearest, nearest) == 0) {
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] += differences[i][axis];
      for (double& x : nearest) x /= static_cast<double>(count);
      in_hull = true;
    }
    for (int step = 0; step < kDirections; ++step) {
      std::size_t lowest = 0;
      double least = dot(nearest, differences[0]);
      for (std::size_t i = 1; i < count; ++i)
        if (const double value = dot(nearest, differences[i]); value < least) {
          least = value;
          lowest = i;
        }
      const double bound = kLength * 0x1p-53 *
                           (std::abs(nearest[0]) * extent_[0] + std::abs(nearest[1]) * extent_[1] +
                            std::abs(nearest[2]) * extent_[2]);
      if (least > bound && bound >= kSmallestBound) {
        direction_ = nearest;
        return true;
      }
      const auto& corner = differences[lowest];
      if (!in_hull) {
        nearest = corner;
        in_hull = true;
        continue;
      }
      // The point nearest to zero of the segment from `nearest` to that corner.
      std::array<double, 3> along;
      for (std::size_t axis = 0; axis < 3; ++axis) along[axis] = corner[axis] - nearest[axis];
      const double squared = dot(along, along);
      if (squared == 0) return false;
      const double share = std::clamp(-dot(nearest, along) / squared, 0.0, 1.0);
      for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] += share * along[axis];
    }
    return false;
  }

  enum class Inside : std::uint8_t { yes, no, unknown };

  /// Where the elements are in the projections, throughout the part.
  Inside inside(const Part& p) const {
    Inside result = Inside::unknown;
    for (int axis = 0; axis < 3; ++axis) {
      const double bound = area_bound_[static_cast<std::size_t>(axis)];
      const auto turn = [&](int a, int b, int c) {
        return common_sign(orientation(p, a, b, c, axis), bound);
      };
      if (kind_ == ImpactKind::vertex_triangle) {
        const int ab = turn(1, 2, 0), bc = turn(2, 3, 0), ca = turn(3, 1, 0);
        if (ab * bc < 0 || bc * ca < 0 || ca * ab < 0) return Inside::no;
        // Three turns of one sign add up to the normal's component, which then is not zero.
        if (ab != 0 && ab == bc && bc == ca) result = Inside::yes;
      } else {
        const int a = turn(0, 1, 2) * turn(0, 1, 3), b = turn(2, 3, 0) * turn(2, 3, 1);
        if (a > 0 || b > 0) return Inside::no;
        // Ends strictly on both sides: the edges are not parallel in this projection.
        if (a < 0 && b < 0) result = Inside::yes;
      }
    }
    return result;
  }

  /// Decides at the one root of f within [from, to], where f has the coefficients c.
  FilteredImpact decide_at_root(const std::array<Real, 4>& c, double from, double to,
                                Inside where) const {
    // Where it is: by bisection and Newton's steps in doubles, without any claim.
    std::array<double, 4> d;
    for (std::size_t i = 0; i < 4; ++i) d[i] = Precision<Real>::leading(c[i]);
    double low = 0, high = 1, u = d[0] / (d[0] - d[3]), slope = 0;
    for (int step = 0; step < 20; ++step) {
      const double s = 1 - u;
      const double value = ((d[0] * s + d[1] * u) * s + d[2] * (u * u)) * s + d[3] * (u * u * u);
      slope =
          (d[1] - 3 * d[0]) * (s * s) + 2 * (d[2] - d[1]) * (s * u) + (3 * d[3] - d[2]) * (u * u);
      if (std::abs(value) < 0x1p-45 * std::abs(slope)) break;
      ((value < 0) == (d[0] < 0) ? low : high) = u;
      u -= value / slope;
      if (!(u > low && u < high)) u = 0.5 * (low + high);
    }
    // A small part around it, at whose ends the signs are certain.
    const double width = to - from;
    const double margin = std::max(0x1p-40, width * (4 * volume_bound_ / std::abs(slope)));
    const auto on_grid = [&](double t) {
      return std::clamp(std::floor(t * 0x1p50) * 0x1p-50, from, to);
    };
    const double before = on_grid(from + width * u - margin);
    const double after = on_grid(from + width * u + margin);
    const Part p = part(before, after);
    const auto f = determinant(p);
    const int sign = certain_sign(c[0], volume_bound_);
    if (certain_sign(f[0], volume_bound_) != sign || certain_sign(f[3], volume_bound_) != -sign)
      return {};
    if (where == Inside::unknown) where = inside(p);
    if (where == Inside::unknown) return {};
    return {where == Inside::yes ? FilterVerdict::contact : FilterVerdict::apart, before, after};
  }

  /// The first contact in [from, to], of 2^-halvings.
  FilteredImpact decide(double from, double to, int halvings) {
    const Part p = part(from, to);
    if (separated(p)) return {FilterVerdict::apart};
    const auto f = determinant(p);
    if (common_sign(f, volume_bound_) != 0) return {FilterVerdict::apart};
    const Inside where = inside(p);
    if (where == Inside::no) return {FilterVerdict::apart};
    const int at_start = certain_sign(f[0], volume_bound_);
    const bool one_root = at_start * certain_sign(f[3], volume_bound_) < 0 &&
                          (certain_sign(f[1], volume_bound_) == at_start ||
                           certain_sign(f[2], volume_bound_) == -at_start);
    if (one_root) return decide_at_root(f, from, to, where);
    if (halvings >= kHalvings) return {};
    const double middle = 0.5 * (from + to);
    FilteredImpact first = decide(from, middle, halvings + 1);
    if (first.verdict != FilterVerdict::apart) return first;
    return decide(middle, to, halvings + 1);
  }

  ImpactKind kind_;
  std::array<Vector, 4> start_, end_;
  std::array<double, 3> extent_;
  bool usable_ = false;
  double volume_bound_ = 0;
  std::array<double, 3> area_bound_;
  std::array<double, 3> direction_;
};

/// Narrows [low, high], which holds one root of f, to kImpactTimeWidth by Newton's steps.
FilteredImpact narrowed(const ImpactQuery& query, double low, double high) {
  // f is known to about 2^-53 of its terms in doubles; 40 bits of the time need more.
  const Filter<DoubleDouble> fine(query);
  const double bound = fine.volume_bound();
  const auto value_at = [&](double t) { return fine.determinant_at(t); };
  const int before = certain_sign(value_at(low), bound);
  if (before == 0) return {};
  double guess = 0.5 * (low + high), width = high - low;
  for (int step = 0; step < 60; ++step) {
    // From a multiple of 2^-42 to one of 2^-41 further on, within the interval.
    double from = std::floor((guess - 0x1p-42) * 0x1p42) * 0x1p-42;
    from = std::clamp(from, low, high - 0x1p-41);
    const double to = from + 0x1p-41;
    const DoubleDouble at_from = value_at(from), at_to = value_at(to);
    const int from_sign = certain_sign(at_from, bound), to_sign = certain_sign(at_to, bound);
    if (from_sign == 0 || to_sign == 0) return {};
    if (from_sign == before && to_sign == -before) return {FilterVerdict::contact, from, to};
    if (from_sign == -before) {
      high = from;
    } else {
      low = to;
    }
    if (high - low < 0x1p-41) return {};
    // The slope between the two; a step that leaves the interval, or that is the second in a row
    // not to halve it, is a bisection.
    const double slope = (at_to - at_from).high * 0x1p41;
    guess = from - at_from.high / slope;
    if (!(guess > low && guess < high) || high - low > 0.5 * width) guess = 0.5 * (low + high);
    width = high - low;
  }
  return {};
}

}  // namespace

FilteredImpact filter_impact(const ImpactQuery& query, double until) {
  const FilteredImpact answer = Filter<double>(query).decide();
  if (answer.verdict != FilterVerdict::contact || answer.earliest > until) return answer;
  return narrowed(query, answer.earliest, answer.latest);
}

}  // namespace contactcheck
