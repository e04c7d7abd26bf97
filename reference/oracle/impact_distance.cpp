// Places become integers by a common power of two, so that all lengths are integers or fractions.
//
// At a moment, the distance is that of two closest points: exact, and a bound from above of the
// smallest distance over the step.
//
// From below, on a piece [a, b] of the step. For a direction d, let g be the smallest d . (p - q)
// over the vertices p of the first element and q of the second one. The distance is at least
// g / |d|: no two points have a larger (p - q) . d than |p - q| |d|, and g is smallest at vertices.
//
// Times are shares s in [0, 1] of the piece; x(s) = p - q = (1 - s) x(a) + s x(b) is linear.
//   1. Constant d: g is smallest at an end of the piece, because d . x(s) is linear.
//   2. d(s) = (1 - s) d(a) + s d(b): d(s) . x(s) is quadratic, and at least the smallest of its
//      Bernstein coefficients d(a) . x(a), (d(a) . x(b) + d(b) . x(a)) / 2 and d(b) . x(b).
//      |d(s)| is at most the larger one of |d(a)| and |d(b)|.
//   3. d(s) = u(s) x v(s), the normal of the face or of both edges, with linear u and v: quadratic
//      with Bernstein coefficients n0, n1, n2, so |d(s)| is at most the quadratic of |n0|, |n1|,
//      |n2|. d . x is the same for all vertices, and a cubic. Both as cubics with coefficients h_i
//      and l_i: the quotient is at least the smallest h_i / l_i, if no h_i is negative.
// 1 is exact where the direction between the closest points does not change. 2, with those
// directions at both ends brought to one length, is off by the square of the piece's length times
// the elements' size; 3 by the square times the distance, which matters if an element slides along
// another one that turns.
#include "reference/oracle/impact_distance.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reference/oracle/floating_point.h"

namespace contactcheck::oracle {
namespace {

/// Bounds are tight when they differ by a factor of at most 1 + 2^-this. Each bit more doubles the
/// number of pieces where distances stay nearly the same.
constexpr unsigned kTightBits = 10;

/// Digits of a direction's length, beyond those of its square's integer root: directions of one
/// piece are brought to one length with this relative error, which bound 2 loses.
constexpr unsigned kLengthBits = 64;

/// Subdivision ends, too, when the squared directions of all moments have this many bits: ordinary
/// queries have 500 a moment and reach kMostPieces first. Coordinates over the whole range of
/// doubles have 20,000, at up to 1 ms a moment.
constexpr std::size_t kMostBits = 600'000;

mpz_class shifted(const mpz_class& value, unsigned bits) {
  mpz_class result;
  mpz_mul_2exp(result.get_mpz_t(), value.get_mpz_t(), bits);
  return result;
}

/// A double as mantissa 2^exponent, with an odd mantissa; or 0.
struct Parts {
  mpz_class mantissa;
  int exponent = 0;
};

/// @pre finite
Parts parts_of(double value) {
  if (value == 0) return {};
  int exponent = 0;
  auto mantissa = static_cast<long>(std::ldexp(std::frexp(value, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<unsigned long>(mantissa));
  return {mpz_class(mantissa >> zeros), exponent - 53 + zeros};
}

/// The square of a length, over / under, in squares of the query's unit. under > 0
struct Square {
  mpz_class over = 0, under = 1;

  friend bool operator<(const Square& a, const Square& b) {
    return a.over * b.under < b.over * a.under;
  }
  friend bool operator<=(const Square& a, const Square& b) { return !(b < a); }
};

/// @param unit the query's unit is 2^unit metres
Square square_of(double metres, int unit) {
  const auto [mantissa, exponent] = parts_of(metres);
  if (mantissa == 0) return {};
  const int bits = 2 * (exponent - unit);
  Square result{mantissa * mantissa, 1};
  mpz_class& shift = bits > 0 ? result.over : result.under;
  shift = shifted(shift, static_cast<unsigned>(std::abs(bits)));
  return result;
}

/// The largest double whose square is at most this.
double root_below(const Square& square, int unit) {
  if (square.over == 0) return 0;
  constexpr double kLargest = std::numeric_limits<double>::max();
  long over_exponent = 0, under_exponent = 0;
  double ratio = mpz_get_d_2exp(&over_exponent, square.over.get_mpz_t()) /
                 mpz_get_d_2exp(&under_exponent, square.under.get_mpz_t());
  long exponent = over_exponent - under_exponent;
  if (exponent % 2 != 0) ratio *= 2, --exponent;
  const long root_exponent = std::clamp(exponent / 2 + unit, -3000L, 3000L);
  // A guess that is off by some units in the last place, and in range.
  double root = std::min(std::ldexp(std::sqrt(ratio), static_cast<int>(root_exponent)), kLargest);
  while (square < square_of(root, unit)) root = std::nextafter(root, 0.0);
  for (;;) {
    const double next = std::nextafter(root, std::numeric_limits<double>::infinity());
    if (!std::isfinite(next) || square < square_of(next, unit)) return root;
    root = next;
  }
}

/// The smallest double whose square is at least this; infinite if there is none.
double root_above(const Square& square, int unit) {
  const double below = root_below(square, unit);
  if (square <= square_of(below, unit)) return below;
  return std::nextafter(below, std::numeric_limits<double>::infinity());
}

using Vector = std::array<mpz_class, 3>;
using Points = std::array<Vector, 4>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

mpz_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The direction between two points of the elements, of any length, and their distance.
struct Closest {
  Vector direction;  ///< from the second element to the first, or back; zero where they touch
  Square distance;
  bool inside = false;  ///< of the face, or of both edges
};

class ClosestPoints {
 public:
  explicit ClosestPoints(Closest first) : best_(std::move(first)) {}
  void offer(Closest other) {
    if (other.distance < best_.distance) best_ = std::move(other);
  }
  Closest best() && { return std::move(best_); }

 private:
  Closest best_;
};

Closest between_points(const Vector& p, const Vector& q) {
  Vector difference = p - q;
  Square distance{dot(difference, difference), 1};
  return {std::move(difference), std::move(distance), false};
}

/// Where the foot of the perpendicular from p is inside the segment; an end is nearer otherwise.
void offer_foot(const Vector& p, const Vector& a, const Vector& b, ClosestPoints& closest) {
  const Vector edge = b - a, to_point = p - a;
  const mpz_class along = dot(edge, to_point), squared = dot(edge, edge);
  if (along <= 0 || along >= squared) return;
  // Along to_point - edge * along / squared, times squared.
  Vector direction;
  for (std::size_t i = 0; i < 3; ++i) direction[i] = squared * to_point[i] - along * edge[i];
  closest.offer(
      {std::move(direction), {dot(to_point, to_point) * squared - along * along, squared}, false});
}

/// The closest points of two planes or lines with this common normal.
Closest along_normal(Vector normal, const mpz_class& squared, const Vector& between) {
  const mpz_class height = dot(normal, between);
  if (height == 0) return {};
  return {std::move(normal), {height * height, squared}, true};
}

/// Where the foot of the perpendicular from the vertex is in the triangle.
std::optional<Closest> in_face(const Points& points) {
  const auto& [v, a, b, c] = points;
  Vector normal = cross(b - a, c - a);
  const mpz_class squared = dot(normal, normal);
  if (squared == 0) return std::nullopt;
  const Vector to_a = a - v, to_b = b - v, to_c = c - v;
  if (dot(normal, cross(to_a, to_b)) < 0 || dot(normal, cross(to_b, to_c)) < 0 ||
      dot(normal, cross(to_c, to_a)) < 0)
    return std::nullopt;
  return along_normal(std::move(normal), squared, to_a);
}

/// Where the lines' closest points are in both edges.
std::optional<Closest> in_both_edges(const Points& points) {
  const auto& [a0, a1, b0, b1] = points;
  const Vector first = a1 - a0, second = b1 - b0, between = b0 - a0;
  Vector normal = cross(first, second);
  const mpz_class squared = dot(normal, normal);
  if (squared == 0) return std::nullopt;
  for (const Vector& other : {second, first}) {
    const mpz_class share = dot(cross(between, other), normal);
    if (share < 0 || share > squared) return std::nullopt;
  }
  return along_normal(std::move(normal), squared, between);
}

/// Closest points lie on a vertex and the other element's vertex, edge or face, or on two edges.
Closest closest_of(ImpactKind kind, const Points& points) {
  const auto& [p, q, r, s] = points;
  const bool vertex = kind == ImpactKind::vertex_triangle;
  if (auto inside = vertex ? in_face(points) : in_both_edges(points)) return *std::move(inside);
  ClosestPoints closest(between_points(p, r));
  closest.offer(between_points(p, s));
  offer_foot(p, r, s, closest);
  if (vertex) {
    closest.offer(between_points(p, q));
    offer_foot(p, q, r, closest);
    offer_foot(p, q, s, closest);
  } else {
    closest.offer(between_points(q, r));
    closest.offer(between_points(q, s));
    offer_foot(q, r, s, closest);
    offer_foot(r, p, q, closest);
    offer_foot(s, p, q, closest);
  }
  return std::move(closest).best();
}

/// The places of the four points along a direction.
using Extents = std::array<mpz_class, 4>;

Extents extents(const Vector& direction, const Points& points) {
  return {dot(direction, points[0]), dot(direction, points[1]), dot(direction, points[2]),
          dot(direction, points[3])};
}

/// From the second element up to the first; negative where they overlap.
mpz_class gap(ImpactKind kind, const Extents& at) {
  if (kind == ImpactKind::vertex_triangle) return at[0] - std::max({at[1], at[2], at[3]});
  return std::min(at[0], at[1]) - std::max(at[2], at[3]);
}

/// The elements at a time that is a multiple of 2^-halvings.
struct Moment {
  Points points;  ///< in units / 2^halvings
  unsigned halvings = 0;
  Vector direction;           ///< from the second element to the first; zero if they touch
  mpz_class squared, length;  ///< of the direction; the length rounded down, times 2^kLengthBits
  mpz_class gap;              ///< along the direction, in units / 2^halvings
  Square distance;
  bool inside = false;  ///< the closest points are inside the face, or both edges
};

Moment moment_at(ImpactKind kind, Points points, unsigned halvings) {
  Moment moment;
  moment.points = std::move(points);
  moment.halvings = halvings;
  auto [direction, distance, inside] = closest_of(kind, moment.points);
  moment.gap = gap(kind, extents(direction, moment.points));
  if (moment.gap < 0) {
    for (mpz_class& coordinate : direction) coordinate = -coordinate;
    moment.gap = gap(kind, extents(direction, moment.points));
  }
  moment.squared = dot(direction, direction);
  moment.length = sqrt(shifted(moment.squared, 2 * kLengthBits));
  distance.under = shifted(distance.under, 2 * halvings);
  moment.direction = std::move(direction);
  moment.distance = std::move(distance);
  moment.inside = inside;
  return moment;
}

Points at_level(const Moment& moment, unsigned halvings) {
  Points points = moment.points;
  for (Vector& point : points)
    for (mpz_class& coordinate : point)
      coordinate = shifted(coordinate, halvings - moment.halvings);
  return points;
}

Moment middle_of(ImpactKind kind, const Moment& a, const Moment& b) {
  const unsigned halvings = std::max(a.halvings, b.halvings);
  const Points at_a = at_level(a, halvings), at_b = at_level(b, halvings);
  Points points;
  for (std::size_t i = 0; i < 4; ++i) points[i] = at_a[i] + at_b[i];
  return moment_at(kind, std::move(points), halvings + 1);
}

/// The points at both ends of a piece, in units / 2^halvings.
struct PieceEnds {
  Points a, b;
  unsigned halvings;
};

/// Two vectors whose cross product is the normal of the face or of both edges, and one between the
/// elements.
std::array<Vector, 3> frame_of(ImpactKind kind, const Points& points) {
  const auto& [p, q, r, s] = points;
  if (kind == ImpactKind::vertex_triangle) return {r - q, s - q, q - p};
  return {q - p, s - r, r - p};
}

/// Times 2^kLengthBits, rounded up.
mpz_class length_above(const Vector& v) { return sqrt(shifted(dot(v, v), 2 * kLengthBits)) + 1; }

/// The square of height / sqrt(squared), for heights in units / 2^halvings; 0 if not positive.
Square slab(const mpz_class& height, const mpz_class& squared, unsigned halvings) {
  if (height <= 0) return {};
  return {height * height, shifted(squared, 2 * halvings)};
}

/// By 1 and 2 above.
Square bound_by_directions(ImpactKind kind, const Moment& a, const Moment& b, const PieceEnds& on) {
  const Extents b_along_a = extents(a.direction, on.b), a_along_b = extents(b.direction, on.a);
  const mpz_class gap_a = shifted(a.gap, on.halvings - a.halvings),
                  gap_b = shifted(b.gap, on.halvings - b.halvings);
  const mpz_class from_a = std::min(gap_a, gap(kind, b_along_a)),
                  from_b = std::min(gap_b, gap(kind, a_along_b));
  const Square constant =
      std::max(slab(from_a, a.squared, on.halvings), slab(from_b, b.squared, on.halvings));
  // Each direction times the length of the other one; twice the coefficients.
  Extents middle;
  for (std::size_t i = 0; i < 4; ++i) middle[i] = b.length * b_along_a[i] + a.length * a_along_b[i];
  const mpz_class at_a = 2 * b.length * gap_a, at_b = 2 * a.length * gap_b;
  const mpz_class turning = std::min({at_a, gap(kind, middle), at_b});
  const mpz_class of_a = b.length * b.length * a.squared, of_b = a.length * a.length * b.squared;
  return std::max(constant, slab(turning, 4 * std::max(of_a, of_b), on.halvings));
}

/// By 3 above.
Square bound_by_normal(ImpactKind kind, const PieceEnds& on) {
  const auto [u_a, v_a, w_a] = frame_of(kind, on.a);
  const auto [u_b, v_b, w_b] = frame_of(kind, on.b);
  const Vector n_a = cross(u_a, v_a), n_b = cross(u_b, v_b);
  const Vector n_ab = cross(u_a, v_b) + cross(u_b, v_a);  // twice the middle coefficient
  std::array<mpz_class, 4> heights = {dot(n_a, w_a), dot(n_a, w_b) + dot(n_ab, w_a),
                                      dot(n_ab, w_b) + dot(n_b, w_a), dot(n_b, w_b)};
  const int side = sgn(heights[0]);
  for (const mpz_class& height : heights)
    if (side == 0 || sgn(height) != side) return {};
  const mpz_class a = length_above(n_a), ab = length_above(n_ab), b = length_above(n_b);
  const std::array<mpz_class, 4> lengths = {a, a + ab, ab + b, b};
  std::optional<Square> lowest;
  for (std::size_t i = 0; i < 4; ++i) {
    const mpz_class height = shifted(abs(heights[i]), kLengthBits);
    Square square = slab(height, lengths[i] * lengths[i], on.halvings);
    if (!lowest || square < *lowest) lowest = std::move(square);
  }
  return *lowest;
}

/// A bound of the distance from below over the piece between two moments.
Square bound_between(ImpactKind kind, const Moment& a, const Moment& b) {
  const unsigned halvings = std::max(a.halvings, b.halvings);
  const PieceEnds on{at_level(a, halvings), at_level(b, halvings), halvings};
  Square bound = bound_by_directions(kind, a, b, on);
  if (a.inside && b.inside) bound = std::max(bound, bound_by_normal(kind, on));
  return bound;
}

/// A part of the step, between two moments.
struct Piece {
  std::size_t from, to;
  Square at_least;
};

struct LowestFirst {
  bool operator()(const Piece& a, const Piece& b) const { return b.at_least < a.at_least; }
};

class Subdivision {
 public:
  Subdivision(ImpactKind kind, Points start, Points end) : kind_(kind) {
    moments_.push_back(moment_at(kind, std::move(start), 0));
    moments_.push_back(moment_at(kind, std::move(end), 0));
    at_most_ = std::min(moments_[0].distance, moments_[1].distance);
    add(0, 1);
  }

  const Square& at_start() const { return moments_[0].distance; }
  const Square& at_most() const { return at_most_; }
  const Square& at_least() const { return pieces_.top().at_least; }
  bool exhausted() const { return pieces_.size() >= kMostPieces || bits_ >= kMostBits; }

  void halve_lowest() {
    const auto [from, to] = std::pair(pieces_.top().from, pieces_.top().to);
    pieces_.pop();
    const std::size_t middle = moments_.size();
    moments_.push_back(middle_of(kind_, moments_[from], moments_[to]));
    at_most_ = std::min(at_most_, moments_[middle].distance);
    bits_ += mpz_sizeinbase(moments_[middle].squared.get_mpz_t(), 2);
    add(from, middle);
    add(middle, to);
  }

 private:
  void add(std::size_t from, std::size_t to) {
    pieces_.push({from, to, bound_between(kind_, moments_[from], moments_[to])});
  }

  ImpactKind kind_;
  std::deque<Moment> moments_;
  std::priority_queue<Piece, std::vector<Piece>, LowestFirst> pieces_;
  Square at_most_;
  std::size_t bits_ = 0;
};

NearVerdict verdict_of(const Subdivision& step, const Square& limit) {
  if (step.at_most() <= limit) return NearVerdict::kNear;
  return limit < step.at_least() ? NearVerdict::kSpurious : NearVerdict::kUndecided;
}

/// Whether both bounds are within a factor of 1 + 2^-kTightBits, or far below the limit.
bool tight(const Subdivision& step, const Square& limit) {
  const mpz_class above = (1U << kTightBits) + 1;
  const Square& least = step.at_least();
  const Square most{shifted(step.at_most().over, 2 * kTightBits), step.at_most().under};
  return most <= Square{least.over * above * above, least.under} || most <= limit;
}

/// The lowest exponent among the coordinates, of which all are multiples then.
int unit_of(const ImpactQuery& query) {
  std::optional<int> lowest;
  for (const auto* places : {&query.start, &query.end})
    for (const Vec3& point : *places)
      for (const double value : {point.x(), point.y(), point.z()})
        if (value != 0) {
          const int exponent = parts_of(value).exponent;
          lowest = lowest ? std::min(*lowest, exponent) : exponent;
        }
  return lowest.value_or(0);
}

Points in_units(const std::array<Vec3, 4>& points, int unit) {
  Points result;
  for (std::size_t i = 0; i < 4; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto [mantissa, exponent] = parts_of(points[i][axis]);
      if (mantissa != 0)
        result[i][static_cast<std::size_t>(axis)] =
            shifted(mantissa, static_cast<unsigned>(exponent - unit));
    }
  return result;
}

void refuse_unless_length(const char* name, double value) {
  if (std::isfinite(value) && value >= 0) return;
  throw std::invalid_argument(std::string("the tolerance ") + name + " is " +
                              std::to_string(value) + ", finite and at least 0 is allowed");
}

}  // namespace

NearMiss near_miss(const ImpactQuery& query, const ImpactTolerance& tolerance) {
  const FloatingPointGuard guard;
  refuse_unless_length("absolute", tolerance.absolute);
  refuse_unless_length("of_start", tolerance.of_start);
  const int unit = unit_of(query);
  Subdivision step(query.kind, in_units(query.start, unit), in_units(query.end, unit));
  Square of_start = square_of(tolerance.of_start, 0);
  of_start.over *= step.at_start().over;
  of_start.under *= step.at_start().under;
  const Square limit = std::max(square_of(tolerance.absolute, unit), of_start);
  while (!step.exhausted() &&
         (verdict_of(step, limit) == NearVerdict::kUndecided || !tight(step, limit)))
    step.halve_lowest();
  return {verdict_of(step, limit), root_below(step.at_least(), unit),
          root_above(step.at_most(), unit)};
}

}  // namespace contactcheck::oracle
