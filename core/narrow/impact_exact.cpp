// Signs of polynomials at roots of polynomials, in integers.
//
// Forms. With s = 1 - t, a polynomial in t of degree n is written sum c_i s^(n-i) t^i. Within the
// step its sign is that of sum c_i x^i for x = t / (1 - t), and x goes from 0 to oo. Near t = 0 the
// sign is that of the first c_i that is not zero, near t = 1 of the last one, and Descartes' rule
// bounds the number of roots within by the sign changes of the c_i. A linear motion is the form
// (place at 0, place at 1), and products of forms are products of polynomials.
//
// Subintervals. On [k, k + 1] / 2^m the motion, times 2^m, is again a motion from integer places to
// integer places. So every question about a subinterval is asked of that motion, on (0, 1).
//
// Contact at an instant t is a statement about signs at t: if the four points are coplanar at t and
// the normal n is not zero there, about signs of components of products of differences, projected
// along an axis along which n is not zero; if n is zero, a point lies on a segment. (In
// contact_at.)
//
// When the determinant f of the four points is not identically zero, the elements can meet only at
// its roots. When it is, the points stay in a plane, which may turn. Let the signs of all
// orientations of three of the points, projected along each axis, be constant within an open
// interval of t, and one of them not zero there. Then that axis projects the plane one to one
// within the interval, and the elements meet there always or never: whether two segments meet, or a
// point lies in a triangle, is decided by the orientations of all triples, of which not all are
// zero. When all of them are zero all the time, everything stays on one line, and the same holds
// for the signs of the differences of coordinates. The set of times of contact is closed, so if it
// is not empty, its first time is 0 or 1 or a root of one of these polynomials.
//
// Signs at roots. Let D have roots in (0, oo), and G be the polynomial whose sign is wanted there.
// The Cauchy index of H / D over (0, oo), the number of its jumps from -oo to +oo less those from
// +oo to -oo, is the number of sign changes of the Sturm chain of (D, H) at 0 less that at oo. For
// H = D' G it is the sum of the signs of G over the different roots of D, multiple ones included
// (Tarski). Intervals are halved to a width of 2^-41. Where one holds a single sign change of D, it
// holds one root, at which D' has the sign of D's last coefficient. Where one still holds more,
// roots may be multiple or closer than that, and sums over all roots, weighted by signs of D' and
// D'', tell their signs apart (in RootSigns).
//
// Width. Let places be integers below 2^B, after division by the lowest bit of all coordinates of
// an axis; B <= 2098. On subintervals they are times 2^41. With d = B + 42 differences are below
// 2^d. Coefficients are below
//   * 2^q of products of two differences and of sums of three such, q = 2d + 3: at most six
//   products
//   * 2^c of D, c = 3d + 5: six products of three, three ways to be in the middle: 18 < 2^5
//   * 2^h of D' D' G, h = 2 (c + 2) + q + 4: D' is below 2^(c + 2), and each of the two products
//     adds up at most three terms
// A step of the remainder by a divisor of w bits adds w + 1. So there are
//   * r1 = h + 4 (c + 1) bits after four steps by D
//   * r2 = c + 2 (r1 + 1) after two of D by that
//   * r3 = r1 + 2 (r2 + 1) after two of the first by the second
// For B = 2098: d = 2140, q = 4283, c = 6425, h = 17141, r1 = 42845, r2 = 92117, r3 = 227081 bits,
// 3549 limbs. (Chains whose degrees fall faster take more steps with smaller numbers; none is
// wider.)
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/narrow/exact_integer.h"
#include "core/narrow/impact.h"

namespace contactcheck {
namespace {

/// Halvings of [0, 1]: intervals of width 2^-41. The width above rests on this.
constexpr int kDeepest = 41;

/// Coefficients c_i of a form of degree at most 6, lowest i first.
struct Form {
  std::array<WideInteger, 7> c;
  int degree = 0;

  bool zero() const {
    for (int i = 0; i <= degree; ++i)
      if (c[at(i)].sign() != 0) return false;
    return true;
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const WideInteger& operator[](int i) const { return c[at(i)]; }
  WideInteger& operator[](int i) { return c[at(i)]; }
  /// Sign near t = 0 and near t = 1, from within. 0 for the zero form.
  int first_sign() const {
    for (int i = 0; i <= degree; ++i)
      if (const int sign = c[at(i)].sign()) return sign;
    return 0;
  }
  int last_sign() const {
    for (int i = degree; i >= 0; --i)
      if (const int sign = c[at(i)].sign()) return sign;
    return 0;
  }
};

Form operator*(const Form& a, const Form& b) {
  Form product;
  product.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i)
    for (int j = 0; j <= b.degree; ++j) product[i + j] = product[i + j] + a[i] * b[j];
  return product;
}

Form operator+(Form a, const Form& b) {
  for (int i = 0; i <= a.degree; ++i) a[i] = a[i] + b[i];
  return a;
}

Form operator-(Form a, const Form& b) {
  for (int i = 0; i <= a.degree; ++i) a[i] = a[i] - b[i];
  return a;
}

int sign_changes(const Form& form) {
  int changes = 0, previous = 0;
  for (int i = 0; i <= form.degree; ++i) {
    const int sign = form[i].sign();
    if (sign == 0) continue;
    if (previous != 0 && sign != previous) ++changes;
    previous = sign;
  }
  return changes;
}

/// The same polynomial in x without roots at x = 0 and without zero leading coefficients, that is
/// without roots at t = 0 and t = 1; other roots stay. @pre not zero
Form without_ends(const Form& form) {
  int first = 0, last = form.degree;
  while (form[first].sign() == 0) ++first;
  while (form[last].sign() == 0) --last;
  Form inner;
  inner.degree = last - first;
  for (int i = first; i <= last; ++i) inner[i - first] = form[i];
  return inner;
}

/// The derivative in x. @pre degree at least 1
Form derivative(const Form& form) {
  Form result;
  result.degree = form.degree - 1;
  for (int i = 1; i <= form.degree; ++i)
    result[i - 1] = form[i] * WideInteger::from_unsigned(static_cast<std::uint64_t>(i));
  return result;
}

/// Drops zero leading coefficients; the zero form has degree 0.
void trim(Form& form) {
  while (form.degree > 0 && form[form.degree].sign() == 0) --form.degree;
}

/// A positive multiple of the remainder of a by b, as polynomials in x. @pre b trimmed and not zero
Form remainder(Form a, const Form& b) {
  const int sign = b[b.degree].sign();
  const WideInteger& lead = b[b.degree];
  trim(a);
  while (a.degree >= b.degree && !a.zero()) {
    const int shift = a.degree - b.degree;
    const WideInteger top = a[a.degree];
    // |lead| a - sign(lead) top x^shift b
    for (int i = 0; i < a.degree; ++i) {
      const WideInteger scaled = sign > 0 ? a[i] * lead : -(a[i] * lead);
      if (i < shift) {
        a[i] = scaled;
      } else {
        const WideInteger taken = top * b[i - shift];
        a[i] = sign > 0 ? scaled - taken : scaled + taken;
      }
    }
    if (a.degree == 0) return Form{};
    a[a.degree] = WideInteger();
    --a.degree;
    trim(a);
  }
  return a;
}

/// The Cauchy index of h / d over x in (0, oo). @pre d trimmed, without a root at 0, not zero
int cauchy_index(const Form& h, const Form& d) {
  Form before = d, last = remainder(h, d);
  int changes_at_zero = 0, changes_at_infinity = 0;
  while (!last.zero()) {
    if (before.first_sign() != last.first_sign()) ++changes_at_zero;
    if (before.last_sign() != last.last_sign()) ++changes_at_infinity;
    if (last.degree == 0) break;  // the next one is zero
    Form next = remainder(before, last);
    for (int i = 0; i <= next.degree; ++i) next[i] = -next[i];
    before = std::exchange(last, std::move(next));
  }
  return changes_at_zero - changes_at_infinity;
}

/// Four points that move from integer places to integer places.
struct Motion {
  /// [point][axis]: place at the start and at the end.
  std::array<std::array<std::array<WideInteger, 2>, 3>, 4> places;
};

using FormVector = std::array<Form, 3>;

FormVector difference(const Motion& motion, int to, int from) {
  FormVector result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis].degree = 1;
    for (std::size_t end = 0; end < 2; ++end)
      result[axis].c[end] =
          motion.places[Form::at(to)][axis][end] - motion.places[Form::at(from)][axis][end];
  }
  return result;
}

Form cross_component(const FormVector& u, const FormVector& v, int axis) {
  const auto first = Form::at((axis + 1) % 3), second = Form::at((axis + 2) % 3);
  return u[first] * v[second] - u[second] * v[first];
}

Form dot(const FormVector& u, const FormVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// Component `axis` of (b - a) x (c - a).
Form orientation(const Motion& motion, int a, int b, int c, int axis) {
  return cross_component(difference(motion, b, a), difference(motion, c, a), axis);
}

/// Component `axis` of the normal of the triangle, or of both edges.
Form normal_component(const Motion& motion, ImpactKind kind, int axis) {
  if (kind == ImpactKind::vertex_triangle) return orientation(motion, 1, 2, 3, axis);
  return cross_component(difference(motion, 1, 0), difference(motion, 3, 2), axis);
}

/// Zero exactly when the four points are coplanar.
Form coplanarity(const Motion& motion, ImpactKind kind) {
  const FormVector across =
      kind == ImpactKind::vertex_triangle ? difference(motion, 0, 1) : difference(motion, 2, 0);
  return normal_component(motion, kind, 0) * across[0] +
         normal_component(motion, kind, 1) * across[1] +
         normal_component(motion, kind, 2) * across[2];
}

/// Whether point p lies on the closed segment from a to b.
template <typename SignOf>
bool on_segment(const Motion& motion, int p, int a, int b, const SignOf& sign_of) {
  for (int axis = 0; axis < 3; ++axis)
    if (sign_of(orientation(motion, a, b, p, axis)) != 0) return false;
  return sign_of(dot(difference(motion, p, a), difference(motion, p, b))) <= 0;
}

/// Whether the elements meet at the instant at which sign_of tells the signs of forms.
/// @pre the four points are coplanar at that instant
template <typename SignOf>
bool contact_at(const Motion& motion, ImpactKind kind, const SignOf& sign_of) {
  for (int axis = 0; axis < 3; ++axis) {
    const int normal = sign_of(normal_component(motion, kind, axis));
    if (normal == 0) continue;
    const auto turn = [&](int a, int b, int c) {
      return sign_of(orientation(motion, a, b, c, axis));
    };
    if (kind == ImpactKind::vertex_triangle)
      return normal * turn(1, 2, 0) >= 0 && normal * turn(2, 3, 0) >= 0 &&
             normal * turn(3, 1, 0) >= 0;
    return turn(0, 1, 2) * turn(0, 1, 3) <= 0 && turn(2, 3, 0) * turn(2, 3, 1) <= 0;
  }
  if (kind == ImpactKind::vertex_triangle)
    return on_segment(motion, 0, 1, 2, sign_of) || on_segment(motion, 0, 2, 3, sign_of) ||
           on_segment(motion, 0, 3, 1, sign_of);
  return on_segment(motion, 0, 2, 3, sign_of) || on_segment(motion, 1, 2, 3, sign_of) ||
         on_segment(motion, 2, 0, 1, sign_of) || on_segment(motion, 3, 0, 1, sign_of);
}

/// The sign of a form everywhere within (0, 1), if its coefficients tell it.
std::optional<int> uniform_sign(const Form& form) {
  bool positive = false, negative = false;
  for (int i = 0; i <= form.degree; ++i) {
    positive |= form[i].sign() > 0;
    negative |= form[i].sign() < 0;
  }
  if (positive && negative) return std::nullopt;
  return positive - negative;
}

/// True when the elements are apart at all times within (0, 1): along an axis the vertex lies
/// strictly outside the projected triangle, or an edge strictly on one side of the other.
bool apart_within(const Motion& motion, ImpactKind kind) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto turn = [&](int a, int b, int c) {
      return uniform_sign(orientation(motion, a, b, c, axis)).value_or(0);
    };
    if (kind == ImpactKind::vertex_triangle) {
      const int ab = turn(1, 2, 0), bc = turn(2, 3, 0), ca = turn(3, 1, 0);
      if (ab * bc < 0 || bc * ca < 0 || ca * ab < 0) return true;
    } else if (turn(0, 1, 2) * turn(0, 1, 3) > 0 || turn(2, 3, 0) * turn(2, 3, 1) > 0) {
      return true;
    }
  }
  return false;
}

/// Signs of forms at the roots of a form within (0, 1).
class RootSigns {
 public:
  /// @pre d not zero, with at least one sign change
  explicit RootSigns(const Form& d) : d_(without_ends(d)), first_(derivative(d_)) {
    if (sign_changes(d_) == 1) {
      count_ = 1;
      single_change_ = true;
      return;
    }
    second_ = derivative(first_);
    count_ = tarski(one());
  }

  /// Number of different roots.
  int count() const { return count_; }

  /// Sign of g at root number `root`. The numbers are of no order, but the same for all g.
  int sign(const Form& g, int root) const {
    if (const auto everywhere = uniform_sign(g)) return *everywhere;
    if (single_change_) return d_.last_sign() * cauchy_index(g, d_);
    const int sum = tarski(g);
    if (count_ == 1) return sum;
    const int by_slope = tarski(g * first_);
    if (count_ == 2) {
      // A double and a simple root: D' is zero at the first and not at the other. Else D' has
      // opposite signs at two simple roots, at the lower one that which leads away from D(0).
      if (const int slopes = tarski(first_)) {
        const int simple = by_slope * slopes;
        return root == 0 ? simple : sum - simple;
      }
      const int difference = -d_.first_sign() * by_slope;
      return root == 0 ? (sum + difference) / 2 : (sum - difference) / 2;
    }
    // Three simple roots. With the sign of D's leading coefficient taken out, D' is +, -, + at them
    // and D'' -, m, +.
    const int lead = d_.last_sign();
    const int middle = (sum - lead * by_slope) / 2;
    if (root == 1) return middle;
    const int outer_sum = sum - middle;
    const int outer_difference = lead * tarski(g * second_) - lead * tarski(second_) * middle;
    return root == 0 ? (outer_sum - outer_difference) / 2 : (outer_sum + outer_difference) / 2;
  }

 private:
  static Form one() {
    Form form;
    form[0] = WideInteger::from_unsigned(1);
    return form;
  }
  /// Sum of the signs of g over the different roots.
  int tarski(const Form& g) const { return cauchy_index(first_ * g, d_); }

  Form d_, first_, second_;
  int count_ = 0;
  bool single_change_ = false;
};

/// An interval of t, as doubles that are exact.
struct Times {
  double low, high;
};

/// [k, k + 1] / 2^halvings.
struct Dyadic {
  std::uint64_t k = 0;
  int halvings = 0;

  double width() const { return 1.0 / static_cast<double>(std::uint64_t{1} << halvings); }
  Times times() const {
    return {static_cast<double>(k) * width(), static_cast<double>(k + 1) * width()};
  }
};

/// The motion on a subinterval, times a power of two.
Motion restricted(const Motion& motion, const Dyadic& part) {
  if (part.halvings == 0) return motion;
  const std::uint64_t all = std::uint64_t{1} << part.halvings;
  const auto integer = [](std::uint64_t value) { return WideInteger::from_unsigned(value); };
  Motion result;
  for (std::size_t point = 0; point < 4; ++point)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& [start, end] = motion.places[point][axis];
      result.places[point][axis] = {start * integer(all - part.k) + end * integer(part.k),
                                    start * integer(all - part.k - 1) + end * integer(part.k + 1)};
    }
  return result;
}

/// The form on a subinterval, times a power of two: s and t become forms of degree 1.
Form restricted(const Form& form, const Dyadic& part) {
  if (part.halvings == 0) return form;
  const std::uint64_t all = std::uint64_t{1} << part.halvings;
  Form s, t;
  s.degree = t.degree = 1;
  s[0] = WideInteger::from_unsigned(all - part.k);
  s[1] = WideInteger::from_unsigned(all - part.k - 1);
  t[0] = WideInteger::from_unsigned(part.k);
  t[1] = WideInteger::from_unsigned(part.k + 1);
  // Horner's scheme in t / s.
  Form result, power;
  result[0] = form[form.degree];
  power[0] = WideInteger::from_unsigned(1);
  for (int i = form.degree - 1; i >= 0; --i) {
    power = power * s;
    Form term = power;
    for (int j = 0; j <= term.degree; ++j) term[j] = term[j] * form[i];
    result = result * t + term;
  }
  return result;
}

/// The sign of the form at t = k / 2^halvings.
int sign_at(const Form& form, const Dyadic& place) {
  const WideInteger t = WideInteger::from_unsigned(place.k);
  const WideInteger s = WideInteger::from_unsigned((std::uint64_t{1} << place.halvings) - place.k);
  // Horner's scheme in t / s.
  WideInteger value = form[form.degree], power = s;
  for (int i = form.degree - 1; i >= 0; --i) {
    value = value * t + form[i] * power;
    if (i > 0) power = power * s;
  }
  return value.sign();
}

/// The part of width 2^-41 in which doubles see the single sign change of d within `part`. A guess:
/// they may be wrong.
Dyadic guessed(const Form& d, Dyadic part, int before) {
  std::size_t limbs = 0;
  for (int i = 0; i <= d.degree; ++i) limbs = std::max(limbs, d[i].size());
  std::array<double, 7> c;
  for (int i = 0; i <= d.degree; ++i) c[Form::at(i)] = d[i].scaled(limbs);
  while (part.halvings < kDeepest) {
    const Dyadic right{2 * part.k + 1, part.halvings + 1};
    const double t = right.times().low, s = 1 - t;
    double value = c[Form::at(d.degree)], power = s;
    for (int i = d.degree - 1; i >= 0; --i, power *= s) value = value * t + c[Form::at(i)] * power;
    part = value * before > 0 ? right : Dyadic{2 * part.k, right.halvings};
  }
  return part;
}

/// A width of 2^-41 around the single root of d within `part`, or the root itself.
/// @pre one sign change of d within `part`
Times narrowed(const Form& d, Dyadic part) {
  const int before = restricted(d, part).first_sign();
  const Dyadic guess = guessed(d, part, before);
  if (sign_at(d, guess) == before && sign_at(d, {guess.k + 1, guess.halvings}) == -before)
    return guess.times();
  while (part.halvings < kDeepest) {
    const Dyadic right{2 * part.k + 1, part.halvings + 1};
    const int at_middle = sign_at(d, right);
    if (at_middle == 0) return {right.times().low, right.times().low};
    part = at_middle == before ? right : Dyadic{2 * part.k, right.halvings};
  }
  return part.times();
}

/// The first time within (0, 1) that is a root of d and at which the elements meet.
/// @pre d is not zero; the four points are coplanar at each of its roots
std::optional<Times> first_contact_at_roots(const Motion& motion, ImpactKind kind, const Form& d) {
  Dyadic part;
  bool left_end_is_new = false;
  while (true) {
    const Form local = restricted(d, part);
    if (left_end_is_new && local[0].sign() == 0) {
      const Motion here = restricted(motion, part);
      if (contact_at(here, kind, [](const Form& form) { return form[0].sign(); }))
        return Times{part.times().low, part.times().low};
    }
    left_end_is_new = false;
    const int changes = sign_changes(local);
    if (changes > 0) {
      const Motion here = restricted(motion, part);
      if (!apart_within(here, kind)) {
        if (changes > 1 && part.halvings < kDeepest) {
          part = {2 * part.k, part.halvings + 1};
          continue;
        }
        const RootSigns roots(local);
        for (int root = 0; root < roots.count(); ++root)
          if (contact_at(here, kind, [&](const Form& form) { return roots.sign(form, root); }))
            return changes == 1 ? narrowed(d, part) : part.times();
      }
    }
    while (part.k % 2 == 1) part = {part.k / 2, part.halvings - 1};
    if (part.halvings == 0) return std::nullopt;
    ++part.k;
    left_end_is_new = true;
  }
}

/// The polynomials at whose roots a planar motion can come into contact.
std::vector<Form> planar_events(const Motion& motion) {
  std::vector<Form> events;
  const auto add = [&](Form form) {
    if (!form.zero()) events.push_back(std::move(form));
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}})
      add(orientation(motion, a, b, c, axis));
  if (!events.empty()) return events;
  for (int from = 0; from < 4; ++from)
    for (int to = from + 1; to < 4; ++to)
      for (Form& form : difference(motion, to, from)) add(std::move(form));
  return events;
}

/// Integer places: each axis over the lowest bit of its coordinates. Contact, collinearity and what
/// lies between what stay the same when an axis is scaled.
Motion integer_motion(const ImpactQuery& query) {
  Motion motion;
  for (int axis = 0; axis < 3; ++axis) {
    int exponent = std::numeric_limits<int>::max();
    for (std::size_t point = 0; point < 4; ++point)
      for (const double value : {query.start[point][axis], query.end[point][axis]})
        if (value != 0) exponent = std::min(exponent, lowest_bit_exponent(value));
    for (std::size_t point = 0; point < 4; ++point)
      motion.places[point][Form::at(axis)] = {
          WideInteger::from_double(query.start[point][axis], exponent),
          WideInteger::from_double(query.end[point][axis], exponent)};
  }
  return motion;
}

Impact at_time(const Times& times) { return {true, false, times.low, times.high}; }

}  // namespace

Impact find_impact_exact(const ImpactQuery& query) {
  const Motion motion = integer_motion(query);
  const ImpactKind kind = query.kind;
  const Form f = coplanarity(motion, kind);
  if (f[0].sign() == 0 && contact_at(motion, kind, [](const Form& form) { return form[0].sign(); }))
    return {true, true, 0, 0};
  std::optional<Times> first;
  if (!f.zero()) {
    first = first_contact_at_roots(motion, kind, f);
  } else {
    for (const Form& event : planar_events(motion)) {
      const auto times = first_contact_at_roots(motion, kind, event);
      if (!times) continue;
      first = first ? Times{std::min(first->low, times->low), std::min(first->high, times->high)}
                    : *times;
    }
  }
  if (first) return at_time(*first);
  if (f[f.degree].sign() == 0 &&
      contact_at(motion, kind, [](const Form& form) { return form[form.degree].sign(); }))
    return at_time({1, 1});
  return {};
}

}  // namespace contactcheck
