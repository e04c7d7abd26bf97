// Places become integers by a common factor. With t in [0, 1], everything asked is the sign of a
// polynomial in t.
//
// The elements can meet only when the four points are coplanar. If their determinant f(t) is not
// identically zero, its roots are the only such times. Else contact can begin only at an end of the
// step, or where an orientation of three points in a projection, or a difference of two
// coordinates, becomes or stops being zero.
//
// Contact at a time, by barycentric coordinates. Of v in the triangle a, b, c with normal n: the
// products of n with (b - v) x (c - v) and so on are not negative. Of two edges with directions d
// and e and n = d x e: their lines meet at shares of both edges, both in [0, 1]:
//   ((b0 - a0) x e) . n / n . n of the first
//   ((b0 - a0) x d) . n / n . n of the second
// If n is zero, an end of one edge, or the vertex, lies on a segment.
#include "reference/oracle/elementary_impact.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace contactcheck::oracle {
namespace {

/// Halvings of [0, 1] after which the interval of a root is narrow enough to be reported.
constexpr int kReportedHalvings = 41;

/// Coefficients by power of t, lowest first; the last one is not zero. Zero has none.
using Polynomial = std::vector<mpz_class>;

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial sum(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) sum[i] += b[i];
  trim(sum);
  return sum;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  Polynomial difference(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) difference[i] -= b[i];
  trim(difference);
  return difference;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      mpz_addmul(product[i + j].get_mpz_t(), a[i].get_mpz_t(), b[j].get_mpz_t());
  return product;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 1; i < p.size(); ++i) result.push_back(p[i] * static_cast<unsigned long>(i));
  return result;
}

/// Divided by the greatest common divisor of its coefficients.
void make_primitive(Polynomial& p) {
  mpz_class divisor;
  for (const mpz_class& c : p) mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), c.get_mpz_t());
  if (divisor > 1)
    for (mpz_class& c : p) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), divisor.get_mpz_t());
}

/// Replaces a by lead(b)^n a - q b of lower degree than b, and returns q.
Polynomial pseudo_divide(Polynomial& a, const Polynomial& b) {
  Polynomial quotient;
  while (a.size() >= b.size()) {
    const std::size_t shift = a.size() - b.size();
    const mpz_class top = a.back();
    for (mpz_class& c : quotient) c *= b.back();
    if (quotient.size() <= shift) quotient.resize(shift + 1);
    quotient[shift] += top;
    for (mpz_class& c : a) c *= b.back();
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= top * b[i];
    trim(a);
  }
  return quotient;
}

/// Up to a constant factor. @pre not both zero
Polynomial greatest_common_divisor(Polynomial a, Polynomial b) {
  make_primitive(a);
  make_primitive(b);
  while (!b.empty()) {
    pseudo_divide(a, b);
    make_primitive(a);
    std::swap(a, b);
  }
  return a;
}

/// The polynomial with the same roots, all of them simple. @pre p is not zero
Polynomial square_free(Polynomial p) {
  make_primitive(p);
  if (p.size() <= 2) return p;
  const Polynomial common = greatest_common_divisor(p, derivative(p));
  if (common.size() > 1) {
    p = pseudo_divide(p, common);
    make_primitive(p);
  }
  return p;
}

/// p(t + 1).
void shift_by_one(Polynomial& p) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = p.size() - 1; j-- > i;) p[j] += p[j + 1];
}

/// Sign changes that bound the number of roots in the open interval (0, 1), and have its parity.
int descartes_bound(Polynomial p) {
  std::reverse(p.begin(), p.end());
  shift_by_one(p);
  int changes = 0, previous = 0;
  for (const mpz_class& c : p) {
    const int sign = sgn(c);
    if (sign != 0 && previous != 0 && sign != previous) ++changes;
    if (sign != 0) previous = sign;
  }
  return changes;
}

/// An interval of t: [k, k + 1] / 2^halvings, or the point k / 2^halvings.
struct Place {
  mpz_class k;
  unsigned halvings = 0;
  bool point = false;
};

/// Times a positive factor: p on the place's interval, as a polynomial on [0, 1].
Polynomial on_interval(const Polynomial& p, const Place& place) {
  // p((k + u) / 2^h) 2^(h n): powers of two first, then the shift by k, by Horner's scheme.
  Polynomial result = p;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
    mpz_mul_2exp(result[i].get_mpz_t(), result[i].get_mpz_t(), place.halvings * (n - 1 - i));
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t j = n - 1; j-- > i;)
      mpz_addmul(result[j].get_mpz_t(), result[j + 1].get_mpz_t(), place.k.get_mpz_t());
  return result;
}

int sign_at_start(const Polynomial& p, const Place& place) {
  const std::size_t n = p.size();
  if (n == 0) return 0;
  mpz_class value = p[n - 1], scaled;
  for (std::size_t i = n - 1; i-- > 0;) {
    value *= place.k;
    mpz_mul_2exp(scaled.get_mpz_t(), p[i].get_mpz_t(), place.halvings * (n - 1 - i));
    value += scaled;
  }
  return sgn(value);
}

int sign_at_end(const Polynomial& p, const Place& place) {
  return sign_at_start(p, {place.k + 1, place.halvings, true});
}

/// Isolates the roots of p in the open interval of `place`, in ascending order.
/// @pre p has no multiple roots
void isolate(const Polynomial& p, const Place& place, std::vector<Place>& roots) {
  const int bound = descartes_bound(on_interval(p, place));
  if (bound == 0) return;
  const bool clean_ends = sign_at_start(p, place) != 0 && sign_at_end(p, place) != 0;
  if (bound == 1 && clean_ends) {
    roots.push_back(place);
    return;
  }
  const Place left{2 * place.k, place.halvings + 1}, right{2 * place.k + 1, place.halvings + 1};
  isolate(p, left, roots);
  if (sign_at_start(p, right) == 0) roots.push_back({right.k, right.halvings, true});
  isolate(p, right, roots);
}

/// A root of a polynomial within (0, 1).
class Root {
 public:
  /// @pre the place holds one root of p, inside it; p has no multiple roots
  Root(const Polynomial& p, Place place) : p_(&p), place_(std::move(place)) {
    if (!place_.point) sign_before_ = sign_at_start(p, place_);
  }

  void halve() {
    if (place_.point) return;
    Place right{2 * place_.k + 1, place_.halvings + 1};
    const int middle = sign_at_start(*p_, right);
    if (middle == 0) {
      right.point = true;
      place_ = std::move(right);
    } else if (middle == sign_before_) {
      place_ = std::move(right);
    } else {
      place_ = {2 * place_.k, right.halvings};
    }
  }

  int sign_of(const Polynomial& g) {
    if (g.empty()) return 0;
    if (place_.point) return sign_at_start(g, place_);
    bool may_be_zero = true;
    while (descartes_bound(on_interval(g, place_)) != 0) {
      if (may_be_zero) {
        // A root that p and g share is one of their greatest common divisor, which has no other
        // root of p in the interval, and p has one there.
        const Polynomial common = greatest_common_divisor(*p_, g);
        if (sign_at_start(common, place_) * sign_at_end(common, place_) < 0) return 0;
        may_be_zero = false;
      }
      halve();
      if (place_.point) return sign_at_start(g, place_);
    }
    // g has no root inside, though perhaps at both ends.
    return sign_at_start(g, {2 * place_.k + 1, place_.halvings + 1, true});
  }

  /// An interval of at most 2^-41 around the root.
  std::pair<double, double> times() {
    while (!place_.point && place_.halvings < kReportedHalvings) halve();
    // Places that were halved more often are widened to the grid of what is reported; points have
    // few bits.
    mpz_class low = place_.k, high = place_.point ? place_.k : mpz_class(place_.k + 1);
    unsigned halvings = place_.halvings;
    while (halvings > kReportedHalvings) {
      mpz_fdiv_q_2exp(low.get_mpz_t(), low.get_mpz_t(), 1);
      mpz_cdiv_q_2exp(high.get_mpz_t(), high.get_mpz_t(), 1);
      --halvings;
    }
    return {std::ldexp(low.get_d(), -static_cast<int>(halvings)),
            std::ldexp(high.get_d(), -static_cast<int>(halvings))};
  }

 private:
  const Polynomial* p_;
  Place place_;
  int sign_before_ = 0;
};

using Vector = std::array<Polynomial, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Motion {
  ImpactKind kind;
  std::array<Vector, 4> points;  ///< of degree at most 1 in t
};

/// @param sign the sign of a polynomial at the time that is asked about
template <typename Sign>
bool on_segment(const Vector& p, const Vector& a, const Vector& b, Sign& sign) {
  const Vector along = b - a, to_point = p - a;
  const auto zero = [&](const Vector& v) {
    return sign(v[0]) == 0 && sign(v[1]) == 0 && sign(v[2]) == 0;
  };
  if (zero(along)) return zero(to_point);
  if (!zero(cross(along, to_point))) return false;
  const Polynomial reached = dot(along, to_point);
  return sign(reached) >= 0 && sign(dot(along, along) - reached) >= 0;
}

template <typename Sign>
bool vertex_on_triangle(const std::array<Vector, 4>& points, Sign& sign) {
  const auto& [v, a, b, c] = points;
  const Vector normal = cross(b - a, c - a);
  if (sign(dot(normal, normal)) > 0) {
    const auto not_negative = [&](const Vector& p, const Vector& q) {
      return sign(dot(normal, cross(p - v, q - v))) >= 0;
    };
    return not_negative(a, b) && not_negative(b, c) && not_negative(c, a);
  }
  return on_segment(v, a, b, sign) || on_segment(v, b, c, sign) || on_segment(v, c, a, sign);
}

template <typename Sign>
bool edges_meet(const std::array<Vector, 4>& points, Sign& sign) {
  const auto& [a0, a1, b0, b1] = points;
  const Vector first = a1 - a0, second = b1 - b0, between = b0 - a0;
  const Vector normal = cross(first, second);
  const Polynomial squared = dot(normal, normal);
  if (sign(squared) > 0) {
    for (const Vector& other : {second, first}) {
      const Polynomial reached = dot(cross(between, other), normal);
      if (sign(reached) < 0 || sign(squared - reached) < 0) return false;
    }
    return true;
  }
  return on_segment(a0, b0, b1, sign) || on_segment(a1, b0, b1, sign) ||
         on_segment(b0, a0, a1, sign) || on_segment(b1, a0, a1, sign);
}

/// @pre the four points are coplanar at the time at which `sign` tells signs
template <typename Sign>
bool in_contact(const Motion& motion, Sign&& sign) {
  return motion.kind == ImpactKind::vertex_triangle ? vertex_on_triangle(motion.points, sign)
                                                    : edges_meet(motion.points, sign);
}

Polynomial coplanarity(const Motion& motion) {
  const auto& [p, q, r, s] = motion.points;
  return dot(cross(q - p, r - p), s - p);
}

/// What can change in a planar motion; none is zero.
std::vector<Polynomial> planar_events(const Motion& motion) {
  std::vector<Polynomial> events;
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::array<const Vector*, 3> triple;
    for (std::size_t i = 0; i < 3; ++i) triple[i] = &motion.points[i + (i >= left_out ? 1 : 0)];
    for (Polynomial& event : cross(*triple[1] - *triple[0], *triple[2] - *triple[0]))
      events.push_back(std::move(event));
  }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (Polynomial& event : motion.points[i] - motion.points[j])
        events.push_back(std::move(event));
  std::erase_if(events, [](const Polynomial& event) { return event.size() < 2; });
  return events;
}

/// The first time within (0, 1) of contact at a root of p, as an interval.
std::optional<std::pair<double, double>> first_contact(const Motion& motion, const Polynomial& p) {
  const Polynomial simple = square_free(p);
  std::vector<Place> places;
  isolate(simple, {}, places);
  for (Place& place : places) {
    Root root(simple, std::move(place));
    if (in_contact(motion, [&](const Polynomial& g) { return root.sign_of(g); }))
      return root.times();
  }
  return std::nullopt;
}

Impact impact_of(const Motion& motion) {
  const Polynomial f = coplanarity(motion);
  const auto contact_at_end = [&](int t) {
    const auto sign = [t](const Polynomial& p) { return sign_at_start(p, {t, 0, true}); };
    return sign(f) == 0 && in_contact(motion, sign);
  };
  if (contact_at_end(0)) return {true, true, 0, 0};
  std::optional<std::pair<double, double>> first;
  for (const Polynomial& event : f.empty() ? planar_events(motion) : std::vector<Polynomial>{f}) {
    const auto times = first_contact(motion, event);
    if (!times) continue;
    first = first ? std::pair(std::min(first->first, times->first),
                              std::min(first->second, times->second))
                  : *times;
  }
  if (!first && contact_at_end(1)) first = {1, 1};
  if (!first) return {};
  return {true, false, first->first, first->second};
}

/// From integer places to integer places: (1 - t) start + t end.
Polynomial moving(const mpz_class& start, const mpz_class& end) {
  Polynomial p{start, end - start};
  trim(p);
  return p;
}

}  // namespace

Impact elementary_impact(const RationalImpactQuery& query) {
  mpz_class denominator = 1;
  for (const auto* places : {&query.start, &query.end})
    for (const auto& point : *places)
      for (const mpq_class& value : point)
        mpz_lcm(denominator.get_mpz_t(), denominator.get_mpz_t(), value.get_den_mpz_t());
  Motion motion{query.kind, {}};
  for (std::size_t point = 0; point < 4; ++point)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const mpq_class start = query.start[point][axis] * denominator;
      const mpq_class end = query.end[point][axis] * denominator;
      motion.points[point][axis] = moving(start.get_num(), end.get_num());
    }
  return impact_of(motion);
}

Impact elementary_impact(const ImpactQuery& query) {
  // A double is m 2^e with a whole m below 2^53: the lowest e among them makes all of them whole.
  int lowest = 0;
  bool any = false;
  const auto exponent_of = [](double value) {
    int exponent = 0;
    std::frexp(value, &exponent);
    return exponent - 53;
  };
  for (const auto* places : {&query.start, &query.end})
    for (const Vec3& point : *places)
      for (const double value : {point.x(), point.y(), point.z()}) {
        if (value == 0) continue;
        lowest = any ? std::min(lowest, exponent_of(value)) : exponent_of(value);
        any = true;
      }
  const auto whole = [&](double value) {
    if (value == 0) return mpz_class(0);
    const int exponent = exponent_of(value);
    mpz_class result(std::ldexp(value, -exponent));
    mpz_mul_2exp(result.get_mpz_t(), result.get_mpz_t(),
                 static_cast<mp_bitcnt_t>(exponent - lowest));
    return result;
  };
  Motion motion{query.kind, {}};
  for (std::size_t point = 0; point < 4; ++point)
    for (int axis = 0; axis < 3; ++axis)
      motion.points[point][static_cast<std::size_t>(axis)] =
          moving(whole(query.start[point][axis]), whole(query.end[point][axis]));
  return impact_of(motion);
}

}  // namespace contactcheck::oracle
