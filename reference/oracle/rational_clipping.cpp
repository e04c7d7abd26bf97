#include "reference/oracle/rational_clipping.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace contactcheck::oracle::rational {
namespace {

using IntegerPoint = std::array<mpz_class, 3>;
using IntegerTriangle = std::array<IntegerPoint, 3>;

IntegerPoint operator-(const IntegerPoint& a, const IntegerPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

mpz_class dot(const IntegerPoint& a, const IntegerPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

IntegerPoint cross(const IntegerPoint& a, const IntegerPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const IntegerPoint& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

// The exponent of a coordinate's last mantissa bit; of zero, none that matters.
int last_bit(double value) {
  if (value == 0.0) return std::numeric_limits<int>::max();
  int exponent = 0;
  std::frexp(value, &exponent);
  return exponent - std::numeric_limits<double>::digits;
}

int last_bit(const TriangleCorners& t) {
  int lowest = std::numeric_limits<int>::max();
  for (const Vec3& corner : t)
    for (int k = 0; k < 3; ++k) lowest = std::min(lowest, last_bit(corner[k]));
  return lowest;
}

// In units of two to the power of `unit`, of which every coordinate is a multiple.
mpz_class integer(double value, int unit) {
  if (value == 0.0) return 0;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  mpz_class out(std::ldexp(mantissa, std::numeric_limits<double>::digits));
  out <<= static_cast<mp_bitcnt_t>(exponent - std::numeric_limits<double>::digits - unit);
  return out;
}

IntegerTriangle integers(const TriangleCorners& t, int unit) {
  IntegerTriangle out;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) out[c][k] = integer(t[c][static_cast<int>(k)], unit);
  return out;
}

/// gradient . x >= offset, or = offset
struct Condition {
  IntegerPoint gradient;
  mpz_class offset;
  bool equation = false;

  mpz_class excess(const IntegerPoint& x) const { return dot(gradient, x) - offset; }
};

Condition condition(IntegerPoint gradient, const IntegerPoint& through, bool equation) {
  mpz_class offset = dot(gradient, through);
  return {std::move(gradient), std::move(offset), equation};
}

// In its plane, and on the inner side of each edge.
std::vector<Condition> conditions_of_proper(const IntegerTriangle& t, const IntegerPoint& normal) {
  std::vector<Condition> out = {condition(normal, t[0], true)};
  for (std::size_t k = 0; k < 3; ++k)
    out.push_back(condition(cross(normal, t[(k + 1) % 3] - t[k]), t[k], false));
  return out;
}

// On the line: (x - from) x edge = 0, one component an equation; and between the ends.
std::vector<Condition> conditions_of_segment(const IntegerPoint& from, const IntegerPoint& to) {
  const IntegerPoint edge = to - from;
  std::vector<Condition> out;
  for (std::size_t k = 0; k < 3; ++k) {
    IntegerPoint gradient;
    gradient[(k + 1) % 3] = edge[(k + 2) % 3];
    gradient[(k + 2) % 3] = -edge[(k + 1) % 3];
    out.push_back(condition(std::move(gradient), from, true));
  }
  out.push_back(condition(edge, from, false));
  out.push_back(condition(from - to, to, false));
  return out;
}

std::vector<Condition> conditions_of_point(const IntegerPoint& point) {
  std::vector<Condition> out;
  for (std::size_t k = 0; k < 3; ++k) {
    IntegerPoint axis;
    axis[k] = 1;
    out.push_back(condition(std::move(axis), point, true));
  }
  return out;
}

std::vector<Condition> conditions_of(const IntegerTriangle& t) {
  const IntegerPoint normal = cross(t[1] - t[0], t[2] - t[0]);
  if (!is_zero(normal)) return conditions_of_proper(t, normal);
  // Collinear corners: in lexicographic order they stand in the order of their line.
  const auto [low, high] = std::minmax_element(t.begin(), t.end());
  return *low == *high ? conditions_of_point(*low) : conditions_of_segment(*low, *high);
}

/// numerator / denominator, the latter positive
struct Fraction {
  mpz_class numerator, denominator = 1;
  bool operator<(const Fraction& other) const {
    return numerator * other.denominator < other.numerator * denominator;
  }
};

/// What is left of an edge, as a range of its parameter.
class ClippedEdge {
 public:
  /// Keeps what is not negative of a linear function, given at both ends.
  void keep_not_negative(const mpz_class& start, const mpz_class& end) {
    const int at_start = sgn(start), at_end = sgn(end);
    if (at_start >= 0 && at_end >= 0) return;
    if (at_start < 0 && at_end < 0) {
      empty_ = true;
    } else if (at_start < 0) {
      low_ = std::max(low_, Fraction{-start, end - start});
    } else {
      high_ = std::min(high_, Fraction{start, start - end});
    }
  }
  bool empty() const { return empty_ || high_ < low_; }
  const Fraction& low() const { return low_; }
  const Fraction& high() const { return high_; }

 private:
  Fraction low_{0, 1}, high_{1, 1};
  bool empty_ = false;
};

using Excesses = std::array<mpz_class, 3>;  ///< of one condition at the three corners

// All corners strictly where the condition does not hold: so is the whole triangle.
bool excludes(const Condition& c, const Excesses& e) {
  const int first = sgn(e[0]);
  return first != 0 && sgn(e[1]) == first && sgn(e[2]) == first && (c.equation || first < 0);
}

ClippedEdge clipped(const std::vector<Condition>& conditions, const std::vector<Excesses>& excesses,
                    std::size_t from, std::size_t to) {
  ClippedEdge edge;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Excesses& e = excesses[i];
    edge.keep_not_negative(e[from], e[to]);
    if (conditions[i].equation) edge.keep_not_negative(-e[from], -e[to]);
    if (edge.empty()) break;
  }
  return edge;
}

enum class Verdict { kApart, kMeet, kNoEdgeMeets };

Verdict clip_edges(const IntegerTriangle& t, const std::vector<Condition>& conditions) {
  std::vector<Excesses> excesses;
  for (const Condition& c : conditions) {
    excesses.push_back({c.excess(t[0]), c.excess(t[1]), c.excess(t[2])});
    if (excludes(c, excesses.back())) return Verdict::kApart;
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (!clipped(conditions, excesses, k, (k + 1) % 3).empty()) return Verdict::kMeet;
  return Verdict::kNoEdgeMeets;
}

// Is an end of what `conditions` leave of an edge of `t` off the piece that `hull` describes?
bool an_end_is_off(const IntegerTriangle& t, const std::vector<Condition>& conditions,
                   const std::vector<Condition>& hull) {
  std::vector<Excesses> excesses;
  for (const Condition& c : conditions)
    excesses.push_back({c.excess(t[0]), c.excess(t[1]), c.excess(t[2])});
  for (std::size_t k = 0; k < 3; ++k) {
    const IntegerPoint &from = t[k], &to = t[(k + 1) % 3];
    const ClippedEdge edge = clipped(conditions, excesses, k, (k + 1) % 3);
    if (edge.empty()) continue;
    for (const Fraction* at : {&edge.low(), &edge.high()})
      for (const Condition& c : hull) {
        // For the point from + at (to - from), times the denominator.
        const mpz_class excess =
            at->denominator * c.excess(from) + at->numerator * dot(c.gradient, to - from);
        if (c.equation ? excess != 0 : excess < 0) return true;
      }
  }
  return false;
}

// The largest power of two of which every coordinate is a multiple.
int unit_of(std::initializer_list<const TriangleCorners*> all) {
  int lowest = std::numeric_limits<int>::max();
  for (const TriangleCorners* t : all) lowest = std::min(lowest, last_bit(*t));
  return lowest == std::numeric_limits<int>::max() ? 0 : lowest;  // all zero
}

}  // namespace

bool triangles_intersect_by_clipping(const TriangleCorners& p, const TriangleCorners& q) {
  const int unit = unit_of({&p, &q});
  const IntegerTriangle ip = integers(p, unit), iq = integers(q, unit);
  const Verdict first = clip_edges(ip, conditions_of(iq));
  if (first != Verdict::kNoEdgeMeets) return first == Verdict::kMeet;
  return clip_edges(iq, conditions_of(ip)) == Verdict::kMeet;
}

bool share_more_than(const Vec3& from, const Vec3& to, const TriangleCorners& p,
                     const TriangleCorners& q) {
  const TriangleCorners segment = {from, to, to};
  const int unit = unit_of({&p, &q, &segment});
  const IntegerTriangle ip = integers(p, unit), iq = integers(q, unit);
  const std::vector<Condition> hull = conditions_of(integers(segment, unit));
  return an_end_is_off(ip, conditions_of(iq), hull) || an_end_is_off(iq, conditions_of(ip), hull);
}

}  // namespace contactcheck::oracle::rational
