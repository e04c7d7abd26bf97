// Where elements are apart, a plane separates them, and still does a little earlier and later: so
// finitely many pieces with a direction each cover all of [0, 1] without contact, and halving finds
// them. Close to a contact they become short; there few pieces need no direction: the volume of the
// four points is not zero before they are in one plane, and in planar motion the line of an edge
// that is about to be met has the other element on one side.
//
// A first contact, where the volume is not identically zero, is at a root of it. If the root is
// simple, and every orientation of three points in a projection is identically zero or not zero
// there, a Crossing in a small interval proves it. Else it is a root of the volume's derivative or
// of an orientation. A first contact in planar motion begins at a root of an orientation or of a
// difference of coordinates. All these have degree 2 at most: the time is known exactly, and so is
// the common point, a Meeting.
#include "reference/oracle/impact_certificate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contactcheck::oracle::certify {
namespace {

// --- Surds. Two that are added or multiplied have the same root, or one is rational.

Surd made(mpq_class x, mpq_class y, const Surd& a, const Surd& b) {
  return {std::move(x), std::move(y), a.root != 0 ? a.root : b.root};
}
Surd rational(mpq_class x) { return {std::move(x), 0, 0}; }
Surd operator+(const Surd& a, const Surd& b) { return made(a.x + b.x, a.y + b.y, a, b); }
Surd operator-(const Surd& a, const Surd& b) { return made(a.x - b.x, a.y - b.y, a, b); }
Surd operator*(const Surd& a, const Surd& b) {
  const mpz_class root = a.root != 0 ? a.root : b.root;
  return made(a.x * b.x + a.y * b.y * root, a.x * b.y + a.y * b.x, a, b);
}
/// @pre b is not zero
Surd operator/(const Surd& a, const Surd& b) {
  const mpq_class norm = b.x * b.x - b.y * b.y * b.root;
  return a * Surd{b.x / norm, -b.y / norm, b.root};
}
/// u |u| grows with u, so x > -y sqrt(root) where x |x| > -y |y| root.
int sign_of(const Surd& a) { return sgn(a.x * abs(a.x) + a.y * abs(a.y) * a.root); }

// --- Polynomials on an interval

/// c[0] (1-s)^n + c[1] (1-s)^(n-1) s + ... + c[n] s^n, for s from 0 to 1 on an interval of t: a sum
/// of products that are not negative. (These are Bernstein coefficients times binomials.)
struct Form {
  std::vector<mpz_class> c;
};

Form operator+(Form a, const Form& b) {
  for (std::size_t i = 0; i < a.c.size(); ++i) a.c[i] += b.c[i];
  return a;
}
Form operator-(Form a, const Form& b) {
  for (std::size_t i = 0; i < a.c.size(); ++i) a.c[i] -= b.c[i];
  return a;
}
Form operator*(const Form& a, const Form& b) {
  Form product{std::vector<mpz_class>(a.c.size() + b.c.size() - 1)};
  for (std::size_t i = 0; i < a.c.size(); ++i)
    for (std::size_t j = 0; j < b.c.size(); ++j)
      mpz_addmul(product.c[i + j].get_mpz_t(), a.c[i].get_mpz_t(), b.c[j].get_mpz_t());
  return product;
}

/// Whether all coefficients, and so the form throughout, have this sign (or are 0, if not strict).
bool has_sign(const Form& form, int sign, bool strict) {
  return std::all_of(form.c.begin(), form.c.end(), [&](const mpz_class& c) {
    return sgn(c) == sign || (!strict && sgn(c) == 0);
  });
}
bool has_one_strict_sign(const Form& form) {
  const int sign = sgn(form.c[0]);
  return sign != 0 && has_sign(form, sign, true);
}

// --- Vectors of whole numbers, forms or surds

template <typename T>
using Vector = std::array<T, 3>;

template <typename T>
Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <typename T>
T cross(const Vector<T>& a, const Vector<T>& b, std::size_t axis) {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  return a[next] * b[last] - a[last] * b[next];
}
template <typename T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {cross(a, b, 0), cross(a, b, 1), cross(a, b, 2)};
}
template <typename T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename T>
using Points = std::array<Vector<T>, 4>;

template <typename T>
T volume(const Points<T>& p) {
  return dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]));
}

/// In a projection: the weights of the four points at the one point that both elements' planes or
/// lines have in common, times `unit`. If the points are in one plane in space and `unit` is not
/// zero, that is a common point of both in space.
template <typename T>
struct Shares {
  T unit;
  std::array<T, 4> of;
};

template <typename T>
Shares<T> shares(ImpactKind kind, const Points<T>& p, std::size_t axis) {
  if (kind == ImpactKind::vertex_triangle) {
    const Vector<T> a = minus(p[1], p[0]), b = minus(p[2], p[0]), c = minus(p[3], p[0]);
    const T of_a = cross(b, c, axis), of_b = cross(c, a, axis), of_c = cross(a, b, axis);
    const T unit = of_a + of_b + of_c;
    return {unit, {unit, of_a, of_b, of_c}};
  }
  const Vector<T> first = minus(p[1], p[0]), second = minus(p[3], p[2]),
                  between = minus(p[2], p[0]);
  const T unit = cross(first, second, axis), of_first = cross(between, second, axis),
          of_second = cross(between, first, axis);
  return {unit, {unit - of_first, of_first, unit - of_second, of_second}};
}

// --- Motion

std::size_t size_of_first(ImpactKind kind) { return kind == ImpactKind::vertex_triangle ? 1 : 2; }

/// In whole numbers, all coordinates times one positive factor.
struct Motion {
  ImpactKind kind;
  Points<mpz_class> start, move;

  /// At t = time, times the positive number `unit`. @pre unit * time is whole
  Points<mpz_class> at(const mpq_class& time, const mpz_class& unit) const {
    const mpz_class steps = time.get_num() * (unit / time.get_den());
    Points<mpz_class> result;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[i][axis] = start[i][axis] * unit + move[i][axis] * steps;
    return result;
  }
};

Motion motion_of(const RationalImpactQuery& query) {
  mpz_class factor = 1;
  for (const auto* places : {&query.start, &query.end})
    for (const auto& point : *places)
      for (const mpq_class& value : point)
        mpz_lcm(factor.get_mpz_t(), factor.get_mpz_t(), value.get_den_mpz_t());
  Motion motion{query.kind, {}, {}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const mpq_class start = query.start[i][axis] * factor, end = query.end[i][axis] * factor;
      motion.start[i][axis] = start.get_num();
      motion.move[i][axis] = end.get_num() - start.get_num();
    }
  return motion;
}

/// The points at both ends of an interval, times one positive factor.
struct Interval {
  Interval(const Motion& motion, const mpq_class& start, const mpq_class& end) {
    mpz_class unit;
    mpz_lcm(unit.get_mpz_t(), start.get_den_mpz_t(), end.get_den_mpz_t());
    at_start = motion.at(start, unit);
    at_end = motion.at(end, unit);
  }

  Points<Form> forms() const {
    Points<Form> result;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[i][axis].c = {at_start[i][axis], at_end[i][axis]};
    return result;
  }

  Points<mpz_class> at_start, at_end;
};

// --- Directions

/// All p - q of corners p of the first element and q of the second.
void append_differences(ImpactKind kind, const Points<mpz_class>& points,
                        std::vector<Vector<mpz_class>>& differences) {
  const std::size_t split = size_of_first(kind);
  for (std::size_t p = 0; p < split; ++p)
    for (std::size_t q = split; q < 4; ++q) {
      differences.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        differences.back()[axis] = points[p][axis] - points[q][axis];
    }
}

bool leads(const Vector<mpz_class>& direction, const std::vector<Vector<mpz_class>>& differences) {
  mpz_class along;
  return std::all_of(differences.begin(), differences.end(), [&](const Vector<mpz_class>& x) {
    along = direction[0] * x[0];
    for (const std::size_t axis : {1, 2})
      mpz_addmul(along.get_mpz_t(), direction[axis].get_mpz_t(), x[axis].get_mpz_t());
    return sgn(along) > 0;
  });
}

/// The point nearest to 0 of the line, plane or point through the given ones, times a positive or
/// zero factor. Of a set of points whose hull does not hold 0, the nearest point of the hull is one
/// of these, for at most three of them.
template <typename T>
Vector<T> nearest_of(const Vector<T>& a) {
  return a;
}
template <typename T>
Vector<T> nearest_of(const Vector<T>& a, const Vector<T>& b) {
  const Vector<T> edge = minus(b, a);
  const T length = dot(edge, edge), reached = dot(a, edge);
  Vector<T> result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = a[axis] * length - edge[axis] * reached;
  return result;
}
template <typename T>
Vector<T> nearest_of(const Vector<T>& a, const Vector<T>& b, const Vector<T>& c) {
  Vector<T> normal = cross(minus(b, a), minus(c, a));
  if (dot(normal, a) < 0)
    for (T& x : normal) x = -x;
  return normal;
}

/// Calls `look` with candidates until it says that it has seen enough.
template <typename T, typename Look>
void each_nearest(const std::vector<Vector<T>>& x, const Look& look) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (look(nearest_of(x[i]))) return;
    for (std::size_t j = 0; j < i; ++j) {
      if (look(nearest_of(x[i], x[j]))) return;
      for (std::size_t k = 0; k < j; ++k)
        if (look(nearest_of(x[i], x[j], x[k]))) return;
    }
  }
}

std::optional<Direction> exact_direction(const std::vector<Vector<mpz_class>>& differences) {
  std::optional<Direction> found;
  each_nearest(differences, [&](const Vector<mpz_class>& candidate) {
    if (!leads(candidate, differences)) return false;
    found = Direction{candidate};
    return true;
  });
  if (!found) return found;
  mpz_class divisor;
  for (const mpz_class& x : found->along)
    mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), x.get_mpz_t());
  for (mpz_class& x : found->along) x /= divisor;
  return found;
}

/// Differences as doubles, every axis divided by a power of two of its own.
struct Rounded {
  std::vector<Vector<double>> differences;
  Vector<long> exponents{};
};

Rounded rounded(const std::vector<Vector<mpz_class>>& differences) {
  Rounded result{std::vector<Vector<double>>(differences.size()), {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t bits = 0;
    for (const auto& x : differences)
      if (x[axis] != 0) bits = std::max(bits, mpz_sizeinbase(x[axis].get_mpz_t(), 2));
    result.exponents[axis] = static_cast<long>(bits);
    for (std::size_t i = 0; i < differences.size(); ++i) {
      long exponent = 0;
      const double mantissa = mpz_get_d_2exp(&exponent, differences[i][axis].get_mpz_t());
      const long scaled = std::max(exponent - result.exponents[axis], -2000L);
      result.differences[i][axis] = std::ldexp(mantissa, static_cast<int>(scaled));
    }
  }
  return result;
}

/// The direction whole, with this many bits for its longest axis.
Vector<mpz_class> whole(const Vector<double>& direction, const Vector<long>& exponents, int bits) {
  const long highest = *std::max_element(exponents.begin(), exponents.end());
  Vector<mpz_class> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis] = std::round(std::ldexp(direction[axis], bits));
    mpz_mul_2exp(result[axis].get_mpz_t(), result[axis].get_mpz_t(),
                 static_cast<mp_bitcnt_t>(highest - exponents[axis]));
  }
  return result;
}

/// A direction that leads along all differences. Doubles choose candidates, and whether it is
/// worthwhile to look at them exactly; what is returned was checked exactly.
std::optional<Direction> find_direction(const std::vector<Vector<mpz_class>>& differences) {
  constexpr double kClose = 1e-6;  // of differences of size 1: what doubles may not tell apart
  const Rounded near = rounded(differences);
  Vector<double> best{};
  double widest = -1;
  each_nearest(near.differences, [&](Vector<double> candidate) {
    const double length = std::sqrt(dot(candidate, candidate));
    if (!(length > 0)) return false;
    for (double& x : candidate) x /= length;
    double least = 4;
    for (const auto& x : near.differences) least = std::min(least, dot(candidate, x));
    if (least > widest) {
      widest = least;
      best = candidate;
    }
    return false;
  });
  if (widest > 0)
    for (const int bits : {8, 24, 52}) {  // short numbers are checked sooner
      const Vector<mpz_class> candidate = whole(best, near.exponents, bits);
      if (leads(candidate, differences)) return Direction{candidate};
    }
  if (std::abs(widest) < kClose) return exact_direction(differences);
  return std::nullopt;
}

// --- Sides

bool is_side(ImpactKind kind, const Points<Form>& points, const Side& side) {
  const Vector<Form> line = minus(points[side.to], points[side.from]);
  const bool of_first = side.from < size_of_first(kind);
  int sign = 0;  // of the first corner of the other element
  const auto beyond = [&](std::size_t i) {
    return cross(line, minus(points[i], points[side.from]), side.axis);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    if ((i < size_of_first(kind)) == of_first) continue;
    const Form area = beyond(i);
    if (sign == 0) sign = sgn(area.c[0]);
    if (sign == 0 || !has_sign(area, sign, true)) return false;
  }
  for (std::size_t i = 0; i < 4; ++i)
    if ((i < size_of_first(kind)) == of_first && i != side.from && i != side.to &&
        !has_sign(beyond(i), -sign, false))
      return false;
  return true;
}

std::optional<Side> find_side(ImpactKind kind, const Points<Form>& points) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t from = 0; from < 4; ++from)
      for (std::size_t to = from + 1; to < 4; ++to) {
        if ((from < size_of_first(kind)) != (to < size_of_first(kind))) continue;
        if (is_side(kind, points, {axis, from, to})) return Side{axis, from, to};
      }
  return std::nullopt;
}

// --- Pieces

class ApartPieces {
 public:
  ApartPieces(const Motion& motion, std::size_t most_intervals)
      : motion_(motion), most_intervals_(most_intervals) {}

  /// Covers [where the last piece ends, end]; false if that has too many pieces, or there is none.
  bool cover(const mpq_class& end) {
    // Intervals still to be covered, by their ends; the next one is the last.
    std::vector<mpq_class> ends{end};
    for (std::size_t intervals = 0; !ends.empty(); ++intervals) {
      if (intervals == most_intervals_) return false;
      if (extend(ends.back()) || add(ends.back())) {
        ends.pop_back();
        continue;
      }
      const mpq_class middle = (reached() + ends.back()) / 2;
      ends.push_back(middle);
    }
    return true;
  }

  std::vector<ApartPiece> pieces;

 private:
  mpq_class reached() const { return pieces.empty() ? mpq_class(0) : pieces.back().end; }

  /// Does the last piece's reason hold until `end`?
  bool extend(const mpq_class& end) {
    if (pieces.empty()) return false;
    ApartPiece& last = pieces.back();
    const mpq_class start = pieces.size() > 1 ? pieces[pieces.size() - 2].end : mpq_class(0);
    const Interval interval(motion_, start, end);
    if (const auto* direction = std::get_if<Direction>(&last.reason)) {
      std::vector<Vector<mpz_class>> differences;
      append_differences(motion_.kind, interval.at_end, differences);
      if (!leads(direction->along, differences)) return false;
    } else if (const auto* side = std::get_if<Side>(&last.reason)) {
      if (!is_side(motion_.kind, interval.forms(), *side)) return false;
    } else if (!has_one_strict_sign(volume(interval.forms()))) {
      return false;
    }
    last.end = end;
    return true;
  }

  bool add(const mpq_class& end) {
    const Interval interval(motion_, reached(), end);
    const Points<Form> forms = interval.forms();
    std::vector<Vector<mpz_class>> differences;
    append_differences(motion_.kind, interval.at_start, differences);
    append_differences(motion_.kind, interval.at_end, differences);
    if (has_one_strict_sign(volume(forms))) {
      pieces.push_back({end, Volume{}});
    } else if (auto direction = find_direction(differences)) {
      pieces.push_back({end, std::move(*direction)});
    } else if (const auto side = find_side(motion_.kind, forms)) {
      pieces.push_back({end, *side});
    } else {
      return false;
    }
    return true;
  }

  const Motion& motion_;
  std::size_t most_intervals_;
};

// --- Crossings

std::optional<Crossing> crossing_on(const Motion& motion, const mpq_class& start,
                                    const mpq_class& end) {
  const Points<Form> points = Interval(motion, start, end).forms();
  const Form f = volume(points);
  if (sgn(f.c.front()) * sgn(f.c.back()) >= 0) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Shares<Form> found = shares(motion.kind, points, axis);
    const int sign = sgn(found.unit.c[0]);
    if (has_one_strict_sign(found.unit) &&
        std::all_of(found.of.begin(), found.of.end(),
                    [&](const Form& share) { return has_sign(share, sign, false); }))
      return Crossing{start, end, axis};
  }
  return std::nullopt;
}

/// Within [start, end], by halving towards roots of the volume.
std::optional<Crossing> find_crossing(const Motion& motion, const mpq_class& start,
                                      const mpq_class& end, std::size_t most_intervals) {
  std::vector<std::pair<mpq_class, mpq_class>> open{{start, end}};
  for (std::size_t intervals = 0; !open.empty() && intervals < most_intervals; ++intervals) {
    const auto [from, to] = std::move(open.back());
    open.pop_back();
    if (has_one_strict_sign(volume(Interval(motion, from, to).forms()))) continue;
    if (auto crossing = crossing_on(motion, from, to)) return crossing;
    const mpq_class middle = (from + to) / 2;
    open.emplace_back(middle, to);
    open.emplace_back(from, middle);
  }
  return std::nullopt;
}

// --- Meetings

Points<Surd> points_at(const Motion& motion, const Surd& time) {
  Points<Surd> points;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      points[i][axis] = rational(mpq_class(motion.start[i][axis])) +
                        rational(mpq_class(motion.move[i][axis])) * time;
  return points;
}

bool is_meeting(ImpactKind kind, const Points<Surd>& points, const std::array<Surd, 4>& weights) {
  Vector<Surd> difference;
  std::array<Surd, 2> sums;
  for (std::size_t i = 0; i < 4; ++i) {
    if (sign_of(weights[i]) < 0) return false;
    const bool first = i < size_of_first(kind);
    sums[first ? 0 : 1] = sums[first ? 0 : 1] + weights[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Surd part = weights[i] * points[i][axis];
      difference[axis] = first ? difference[axis] + part : difference[axis] - part;
    }
  }
  const Surd one = rational(1);
  return sign_of(sums[0] - one) == 0 && sign_of(sums[1] - one) == 0 &&
         std::all_of(difference.begin(), difference.end(),
                     [](const Surd& x) { return sign_of(x) == 0; });
}

/// The weights of a point on the segment from i to j that could be the point p: whether it is one
/// is for the caller to check.
std::array<Surd, 4> on_segment(const Points<Surd>& points, std::size_t p, std::size_t i,
                               std::size_t j) {
  std::array<Surd, 4> weights;
  weights[p] = weights[i] = rational(1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Surd along = points[j][axis] - points[i][axis];
    if (sign_of(along) == 0) continue;
    weights[j] = (points[p][axis] - points[i][axis]) / along;
    weights[i] = rational(1) - weights[j];
    break;
  }
  return weights;
}

/// A common point at this time. With a projection in which the elements' planes or lines are not
/// parallel there is one candidate; else elements meet at an end of an edge, or on a triangle's
/// edge.
std::optional<Meeting> meeting_at(const Motion& motion, const Surd& time) {
  const Points<Surd> points = points_at(motion, time);
  const auto proved = [&](const std::array<Surd, 4>& weights) -> std::optional<Meeting> {
    if (!is_meeting(motion.kind, points, weights)) return std::nullopt;
    return Meeting{time, weights};
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Shares<Surd> found = shares(motion.kind, points, axis);
    if (sign_of(found.unit) == 0) continue;
    std::array<Surd, 4> weights;
    for (std::size_t i = 0; i < 4; ++i) weights[i] = found.of[i] / found.unit;
    return proved(weights);
  }
  using Segment = std::array<std::size_t, 3>;
  constexpr std::array<Segment, 3> kOnTriangle{{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}};
  constexpr std::array<Segment, 4> kOnEdges{{{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}}};
  std::vector<Segment> segments(kOnTriangle.begin(), kOnTriangle.end());
  if (motion.kind == ImpactKind::edge_edge) segments.assign(kOnEdges.begin(), kOnEdges.end());
  for (const auto& [p, i, j] : segments)
    if (auto meeting = proved(on_segment(points, p, i, j))) return meeting;
  return std::nullopt;
}

/// c[0] + c[1] t + c[2] t^2.
using Quadratic = std::array<mpz_class, 3>;

/// Polynomials of which one is zero at the time of a first contact, unless a Crossing proves it.
std::vector<Quadratic> quadratics(const Motion& motion) {
  const Points<Form> points = Interval(motion, 0, 1).forms();
  std::vector<Quadratic> result;
  // The derivative of the volume: double roots of it are roots.
  const std::vector<mpz_class> f = volume(points).c;
  result.push_back(
      {f[1] - 3 * f[0], 2 * (3 * f[0] - 2 * f[1] + f[2]), 3 * (f[1] - f[0] - f[2] + f[3])});
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::array<const Vector<Form>*, 3> triple;
    for (std::size_t i = 0; i < 3; ++i) triple[i] = &points[i + (i >= left_out ? 1 : 0)];
    for (const Form& area : cross(minus(*triple[1], *triple[0]), minus(*triple[2], *triple[0])))
      result.push_back({area.c[0], area.c[1] - 2 * area.c[0], area.c[0] - area.c[1] + area.c[2]});
  }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const Form& gap : minus(points[i], points[j]))
        result.push_back({gap.c[0], gap.c[1] - gap.c[0], 0});
  return result;
}

std::vector<Surd> roots(Quadratic q) {
  mpz_class divisor;
  for (const mpz_class& c : q) mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), c.get_mpz_t());
  if (divisor == 0) return {};
  for (mpz_class& c : q) c /= divisor;
  const auto& [c, b, a] = q;
  if (a == 0 && b == 0) return {};
  if (a == 0) return {rational(mpq_class(-c) / b)};
  const mpz_class discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return {};
  const mpq_class middle = mpq_class(-b) / (2 * a), half = mpq_class(1) / (2 * a);
  if (mpz_perfect_square_p(discriminant.get_mpz_t()) != 0) {
    const mpq_class away = half * sqrt(discriminant);
    return {rational(middle + away), rational(middle - away)};
  }
  return {Surd{middle, half, discriminant}, Surd{middle, -half, discriminant}};
}

std::optional<Meeting> find_meeting(const Motion& motion, const mpq_class& start,
                                    const mpq_class& end) {
  if (start == end) return meeting_at(motion, rational(start));
  for (const Quadratic& quadratic : quadratics(motion))
    for (const Surd& time : roots(quadratic)) {
      if (sign_of(time - rational(start)) < 0 || sign_of(rational(end) - time) < 0) continue;
      if (auto meeting = meeting_at(motion, time)) return meeting;
    }
  return std::nullopt;
}

}  // namespace

std::optional<ImpactCertificate> certify_impact(const RationalImpactQuery& query,
                                                const Impact& answer, std::size_t most_intervals) {
  const Motion motion = motion_of(query);
  ApartPieces apart(motion, most_intervals);
  if (!answer.contact) {
    if (!apart.cover(1)) return std::nullopt;
    return ImpactCertificate{std::move(apart.pieces), {}};
  }
  const mpq_class earliest(answer.earliest), latest(answer.latest);
  // At a time that is known exactly the elements meet: they are apart a little before.
  mpq_class before = earliest;
  if (earliest == latest) before -= mpq_class(kImpactTimeWidth) / 2;
  if (before > 0 && !apart.cover(before)) return std::nullopt;
  ImpactCertificate certificate{std::move(apart.pieces), {}};
  // What is likely and short comes first.
  if (auto crossing = crossing_on(motion, earliest, latest)) {
    certificate.contact = std::move(*crossing);
  } else if (auto meeting = find_meeting(motion, earliest, latest)) {
    certificate.contact = std::move(*meeting);
  } else if (auto halved = find_crossing(motion, earliest, latest, most_intervals)) {
    certificate.contact = std::move(*halved);
  } else {
    return std::nullopt;
  }
  return certificate;
}

std::optional<ImpactCertificate> certify_impact(const ImpactQuery& query, const Impact& answer,
                                                std::size_t most_intervals) {
  RationalImpactQuery exact{query.kind, {}, {}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      exact.start[i][axis] = query.start[i][static_cast<int>(axis)];
      exact.end[i][axis] = query.end[i][static_cast<int>(axis)];
    }
  return certify_impact(exact, answer, most_intervals);
}

}  // namespace contactcheck::oracle::certify
