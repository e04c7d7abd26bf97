// Why the first time of contact is among the times that are tried.
//
// Contact needs the four points in one plane: a root of their determinant f, of degree at most 3.
// If f is not identically zero its roots are all the times there are. Let f be zero throughout, and
// let the first time t* be above 0.
//   1. At t* a vertex or an end x lies on a side, or an edge, p q of the other element. Else the
//      triangle is not degenerate and the vertex strictly inside, or two edges that are not
//      parallel cross strictly inside. In a common plane both would hold shortly before.
//   2. So (q - p) x (x - p) is zero at t*. If a component is not identically zero, t* is its root.
//   3. Else x, p, q stay on a line. Strictly between two different points x would be so shortly
//      before. So x = p or x = q at t*, and t* is a root of a difference of coordinates, which is
//      not identically zero in all three: x would be there from the start.
// The last time likewise, backwards.
#include "tests/odd/rational_impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace contactcheck::test {
namespace {

using Polynomial = IntegerPolynomial;

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

Polynomial minus(const Polynomial& a, const Polynomial& b) {
  Polynomial out(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i];
  for (std::size_t i = 0; i < b.size(); ++i) out[i] -= b[i];
  trim(out);
  return out;
}

void add_product(const Polynomial& a, const Polynomial& b, Polynomial& sum) {
  if (a.empty() || b.empty()) return;
  if (sum.size() < a.size() + b.size() - 1) sum.resize(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) sum[i + j] += a[i] * b[j];
}

Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial out;
  add_product(a, b, out);
  trim(out);
  return out;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial out;
  for (std::size_t i = 1; i < p.size(); ++i) out.push_back(p[i] * static_cast<unsigned long>(i));
  return out;
}

// Without the common factor of its coefficients; signs stay.
void reduce(Polynomial& p) {
  mpz_class common = 0;
  for (const mpz_class& c : p) common = gcd(common, c);
  if (common > 1)
    for (mpz_class& c : p) c /= common;
}

// The remainder of a by b, times a positive number. @pre b is not zero
Polynomial remainder(Polynomial a, const Polynomial& b) {
  const mpz_class lead = abs(b.back());
  const int sign = sgn(b.back());
  while (a.size() >= b.size()) {
    const std::size_t shift = a.size() - b.size();
    const mpz_class top = sign * a.back();
    for (mpz_class& c : a) c *= lead;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= top * b[i];
    trim(a);
  }
  reduce(a);
  return a;
}

// a / b, times a number. @pre it divides
Polynomial quotient(Polynomial a, const Polynomial& b) {
  Polynomial out(a.size() - b.size() + 1);
  while (a.size() >= b.size()) {
    const std::size_t shift = a.size() - b.size();
    const mpz_class top = a.back();
    for (mpz_class& c : a) c *= b.back();
    for (mpz_class& c : out) c *= b.back();
    out[shift] += top;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= top * b[i];
    trim(a);
  }
  reduce(out);
  return out;
}

// Up to a factor. @pre a is not zero
Polynomial common_divisor(Polynomial a, Polynomial b) {
  while (!b.empty()) {
    Polynomial rest = remainder(std::move(a), b);
    a = std::move(b);
    b = std::move(rest);
  }
  return a;
}

int sign_at(const Polynomial& p, const mpq_class& t) {
  const mpz_class &n = t.get_num(), &d = t.get_den();
  mpz_class value = 0, power = 1;  // Horner's scheme, times the denominators so far
  for (std::size_t i = p.size(); i-- > 0;) {
    value = value * n + p[i] * power;
    power *= d;
  }
  return sgn(value);
}

// At k / 2^halvings.
int sign_at(const Polynomial& p, const mpz_class& k, unsigned halvings) {
  mpz_class value = 0;
  for (std::size_t i = p.size(); i-- > 0;)
    value = value * k + (p[i] << (halvings * (p.size() - 1 - i)));
  return sgn(value);
}

/// Sturm's chain of a square-free polynomial.
std::vector<Polynomial> chain_of(const Polynomial& p) {
  std::vector<Polynomial> chain = {p, derivative(p)};
  while (chain.back().size() > 1) {
    Polynomial next = remainder(chain[chain.size() - 2], chain.back());
    for (mpz_class& c : next) c = -c;
    chain.push_back(std::move(next));
  }
  return chain;
}

// At k / 2^halvings.
int changes(const std::vector<Polynomial>& chain, const mpz_class& k, unsigned halvings) {
  int out = 0, before = 0;
  for (const Polynomial& p : chain) {
    const int sign = sign_at(p, k, halvings);
    if (sign == 0) continue;
    out += before != 0 && sign != before;
    before = sign;
  }
  return out;
}

// p(t + by).
void shift(Polynomial& p, const mpz_class& by) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = p.size() - 1; j-- > i;) p[j] += by * p[j + 1];
}

/// The sign that p has in all of the closed interval by its Bernstein coefficients there; none:
/// they do not tell. @pre p is not zero
std::optional<int> sign_within(Polynomial p, const DyadicInterval& interval) {
  // p((k + u) / 2^h) by powers of u, times a positive number.
  const std::size_t degree = p.size() - 1;
  if (interval.halvings > 0) {
    for (std::size_t i = 0; i < degree; ++i) p[i] <<= interval.halvings * (degree - i);
    shift(p, interval.k);
  }
  // The coefficients are, times binomials, those of (1 + x)^n p(1 / (1 + x)).
  std::reverse(p.begin(), p.end());
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = p.size() - 1; j-- > i;) p[j] += p[j + 1];
  const int sign = sgn(p.front());
  if (sign == 0) return std::nullopt;
  for (const mpz_class& c : p)
    if (sgn(c) != sign) return std::nullopt;
  return sign;
}

/// Coordinates of a point as polynomials in t.
using Point = std::array<Polynomial, 3>;

Point operator-(const Point& a, const Point& b) {
  return {minus(a[0], b[0]), minus(a[1], b[1]), minus(a[2], b[2])};
}

Polynomial dot(const Point& a, const Point& b) {
  Polynomial out;
  for (std::size_t k = 0; k < 3; ++k) add_product(a[k], b[k], out);
  trim(out);
  return out;
}

Point cross(const Point& a, const Point& b) {
  Point out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = minus(times(a[(k + 1) % 3], b[(k + 2) % 3]), times(a[(k + 2) % 3], b[(k + 1) % 3]));
  return out;
}

bool is_zero(const Point& p, const ExactTime& t) {
  return std::all_of(p.begin(), p.end(), [&](const Polynomial& c) { return t.sign(c) == 0; });
}

bool on_segment(const Point& x, const Point& p, const Point& q, const ExactTime& t) {
  return is_zero(cross(q - p, x - p), t) && t.sign(dot(x - p, x - q)) <= 0;
}

// @pre the four points are in one plane at t
bool in_triangle(const std::array<Point, 4>& p, const ExactTime& t) {
  const auto& [v, a, b, c] = p;
  const Point normal = cross(b - a, c - a);
  if (is_zero(normal, t))
    return on_segment(v, a, b, t) || on_segment(v, b, c, t) || on_segment(v, c, a, t);
  const auto left = [&](const Point& from, const Point& to) {
    return t.sign(dot(normal, cross(to - from, v - from))) >= 0;
  };
  return left(a, b) && left(b, c) && left(c, a);
}

// @pre the four points are in one plane at t
bool edges_meet(const std::array<Point, 4>& p, const ExactTime& t) {
  const auto& [a, b, c, d] = p;
  const Point normal = cross(b - a, d - c);
  if (is_zero(normal, t))
    return on_segment(a, c, d, t) || on_segment(b, c, d, t) || on_segment(c, a, b, t) ||
           on_segment(d, a, b, t);
  const auto both_sides = [&](const Point& from, const Point& to, const Point& x, const Point& y) {
    return t.sign(dot(normal, cross(to - from, x - from))) *
               t.sign(dot(normal, cross(to - from, y - from))) <=
           0;
  };
  return both_sides(a, b, c, d) && both_sides(c, d, a, b);
}

/// The double times 2^-exponent. @pre a whole number
mpz_class scaled(double value, int exponent) {
  int own = 0;
  const double mantissa = std::frexp(value, &own);
  mpz_class out = static_cast<long>(std::ldexp(mantissa, 53));
  own -= 53;
  if (own >= exponent) return out << static_cast<unsigned long>(own - exponent);
  return out >> static_cast<unsigned long>(exponent - own);  // zeros go
}

/// The power of two of the last binary digit that is not 0.
int last_digit(double value) {
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  while (mantissa % 2 == 0) mantissa /= 2, ++exponent;
  return exponent;
}

/// All points as whole numbers in one unit, relative to the first one.
std::array<Point, 4> points_of(const ImpactQuery& query) {
  int unit = std::numeric_limits<int>::max();
  for (const auto* points : {&query.start, &query.end})
    for (const Vec3& p : *points)
      for (int k = 0; k < 3; ++k)
        if (p[k] != 0.0) unit = std::min(unit, last_digit(p[k]));
  const auto at = [&](const Vec3& p, std::size_t k) -> mpz_class {
    const double value = p[static_cast<int>(k)];
    if (value == 0.0) return 0;
    return scaled(value, unit);
  };
  std::array<Point, 4> out;
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const mpz_class start = at(query.start[i], k) - at(query.start[0], k);
      const mpz_class end = at(query.end[i], k) - at(query.end[0], k);
      out[i][k] = {start, end - start};
      trim(out[i][k]);
    }
  return out;
}

/// Where contact can begin or end while the points stay in one plane.
std::vector<ExactTime> planar_times(ImpactKind kind, const std::array<Point, 4>& p) {
  std::vector<ExactTime> out = {ExactTime(0), ExactTime(1)};
  const auto add = [&](const Point& of) {
    for (const Polynomial& c : of)
      if (!c.empty())
        for (const ExactTime& root : roots_within_step(c)) out.push_back(root);
  };
  const auto add_triple = [&](std::size_t x, std::size_t a, std::size_t b) {
    add(cross(p[b] - p[a], p[x] - p[a]));
    add(p[x] - p[a]);
    add(p[x] - p[b]);
  };
  if (kind == ImpactKind::vertex_triangle) {
    for (const auto& [a, b] : {std::pair(1, 2), {2, 3}, {3, 1}})
      add_triple(0, static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  } else {
    for (const std::size_t i : {0, 1}) {
      add_triple(i, 2, 3);
      add_triple(2 + i, 0, 1);
    }
  }
  return out;
}

}  // namespace

ExactTime::ExactTime(IntegerPolynomial polynomial, DyadicInterval interval)
    : polynomial_(std::move(polynomial)), interval_(std::move(interval)) {
  const auto& [k, halvings] = interval_;
  if (sign_at(polynomial_, k + 1, halvings) == 0) {
    value_ = mpq_class(k + 1, mpz_class(1) << halvings);
    value_->canonicalize();
  }
}

// The root is simple, and at no end: the signs at the ends differ.
void ExactTime::halve() const {
  auto& [k, halvings] = interval_;
  const int at_low = sign_at(polynomial_, k, halvings);
  k *= 2, ++halvings;
  const int at_middle = sign_at(polynomial_, k + 1, halvings);
  if (at_middle == 0) {
    value_ = mpq_class(k + 1, mpz_class(1) << halvings);
    value_->canonicalize();
  } else if (at_middle == at_low) {
    k += 1;
  }
}

int ExactTime::sign(const IntegerPolynomial& of) const {
  constexpr int kHalvings = 6;  // then it may be zero, which is looked at once
  if (of.empty()) return 0;
  for (int i = 0; !value_; ++i) {
    if (const std::optional<int> sign = sign_within(of, interval_)) return *sign;
    if (i == kHalvings) {
      // Of the roots of the polynomial the interval has one, which is simple.
      const Polynomial common = common_divisor(polynomial_, of);
      const auto& [k, halvings] = interval_;
      if (sign_at(common, k, halvings) * sign_at(common, k + 1, halvings) < 0) return 0;
    }
    halve();
  }
  return sign_at(of, *value_);
}

int ExactTime::compared(const mpq_class& other) const {
  while (!value_) {
    // The root is strictly within.
    const mpq_class scaled = other * (mpz_class(1) << interval_.halvings);
    if (scaled <= interval_.k) return 1;
    if (scaled >= interval_.k + 1) return -1;
    if (sign_at(polynomial_, other) == 0) return 0;
    halve();
  }
  return cmp(*value_, other) < 0 ? -1 : cmp(*value_, other) > 0 ? 1 : 0;
}

std::vector<ExactTime> roots_within_step(IntegerPolynomial polynomial) {
  std::vector<ExactTime> out;
  if (polynomial.size() <= 1 || sign_within(polynomial, {0, 0})) return out;
  reduce(polynomial);
  if (const Polynomial common = common_divisor(polynomial, derivative(polynomial));
      common.size() > 1)
    polynomial = quotient(std::move(polynomial), common);
  if (polynomial[0] == 0) out.emplace_back(0);
  const std::vector<Polynomial> chain = chain_of(polynomial);
  // Halves of (0, 1] until each has one root or none, from the left.
  struct Part {
    DyadicInterval interval;
    int low_changes, high_changes;
  };
  std::vector<Part> parts = {{{0, 0}, changes(chain, 0, 0), changes(chain, 1, 0)}};
  while (!parts.empty()) {
    const Part part = std::move(parts.back());
    parts.pop_back();
    const auto& [k, halvings] = part.interval;
    const int roots = part.low_changes - part.high_changes;
    if (roots == 0) continue;
    if (roots == 1 && sign_at(polynomial, k, halvings) != 0) {
      out.emplace_back(polynomial, part.interval);
      continue;
    }
    const mpz_class low = 2 * k, middle = low + 1;
    const int at_middle = changes(chain, middle, halvings + 1);
    parts.push_back({{middle, halvings + 1}, at_middle, part.high_changes});
    parts.push_back({{low, halvings + 1}, part.low_changes, at_middle});
  }
  return out;
}

std::vector<ExactTime> times_of_contact(const ImpactQuery& query) {
  const std::array<Point, 4> p = points_of(query);
  // Relative to the first point.
  const Polynomial coplanar = dot(p[1], cross(p[2], p[3]));
  std::vector<ExactTime> times =
      coplanar.empty() ? planar_times(query.kind, p) : roots_within_step(coplanar);
  std::erase_if(times, [&](const ExactTime& t) {
    return query.kind == ImpactKind::vertex_triangle ? !in_triangle(p, t) : !edges_meet(p, t);
  });
  return times;
}

}  // namespace contactcheck::test
