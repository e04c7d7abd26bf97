#pragma once

#include <gmpxx.h>

#include <vector>

namespace contactcheck::rational {

/// One equation: the coefficients of all unknowns, and the right-hand side.
struct Equation {
  std::vector<mpq_class> coefficients;
  mpq_class right;
};

/// True when the equations have a solution in which no unknown is negative. Exact; phase one of the
/// simplex method, which cannot cycle under Bland's rule.
/// @pre every equation has the same number of coefficients
bool has_nonnegative_solution(std::vector<Equation> equations);

}  // namespace contactcheck::rational
