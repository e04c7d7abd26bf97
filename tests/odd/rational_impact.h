// Contact of a vertex and a triangle, or of two edges, that move straight, by brute force in
// rational arithmetic: at every time at which contact can begin or end, the static test is asked.
//
// Written for tests, and shares no code with the oracle (reference/oracle/elementary_impact.h) or
// with core: roots are counted by Sturm's chain, and a sign at a root is that of a polynomial whose
// Bernstein coefficients agree around it.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <vector>

#include "core/types/impact.h"

namespace contactcheck::test {

/// Coefficients by power of t, lowest first; the last is not 0. Zero has none.
using IntegerPolynomial = std::vector<mpz_class>;

/// The interval (k, k + 1] / 2^halvings.
struct DyadicInterval {
  mpz_class k;
  unsigned halvings = 0;
};

/// A time in [0, 1]: a rational number, or the one root of a polynomial in an interval.
class ExactTime {
 public:
  explicit ExactTime(const mpq_class& value) : value_(value) {}
  /// @pre square-free, with one root in the interval, and none at its lower end
  ExactTime(IntegerPolynomial polynomial, DyadicInterval interval);

  /// The sign of a polynomial at this time.
  int sign(const IntegerPolynomial& of) const;
  /// -1 before the other, 0 at it, 1 after it.
  int compared(const mpq_class& other) const;

 private:
  void halve() const;

  IntegerPolynomial polynomial_;
  mutable DyadicInterval interval_;         // narrowed where a question needs it
  mutable std::optional<mpq_class> value_;  // where it is known to be rational
};

/// The distinct roots in [0, 1], ascending. @pre not zero
std::vector<ExactTime> roots_within_step(IntegerPolynomial polynomial);

/// Times of contact, with the first and the last one among them; none without contact. In no order.
std::vector<ExactTime> times_of_contact(const ImpactQuery& query);

}  // namespace contactcheck::test
