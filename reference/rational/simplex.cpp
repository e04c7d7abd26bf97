// R. G. Bland, "New finite pivoting rules for the simplex method", 1977.

#include "reference/rational/simplex.h"

#include <cstddef>
#include <utility>

namespace contactcheck::rational {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Phase one: each row starts with an artificial unknown of its own, and the sum of the artificial
/// ones is driven down. Only the real unknowns have columns: an artificial one that left the basis
/// never comes back.
class PhaseOne {
 public:
  explicit PhaseOne(std::vector<Equation> rows) : rows_(std::move(rows)) {
    unknowns_ = rows_.front().coefficients.size();
    goal_.coefficients.resize(unknowns_);
    for (Equation& row : rows_) {
      if (row.right < 0) negate(row);
      subtract(goal_, row, mpq_class(-1));
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) basis_.push_back(unknowns_ + i);
  }

  bool solve() {
    for (;;) {
      if (goal_.right == 0) return true;
      const std::size_t column = entering_column();
      if (column == kNone) return false;
      pivot(leaving_row(column), column);
    }
  }

 private:
  static void negate(Equation& row) {
    for (mpq_class& value : row.coefficients) value = -value;
    row.right = -row.right;
  }

  /// row -= factor * other
  static void subtract(Equation& row, const Equation& other, const mpq_class& factor) {
    for (std::size_t i = 0; i < row.coefficients.size(); ++i)
      if (other.coefficients[i] != 0) row.coefficients[i] -= factor * other.coefficients[i];
    row.right -= factor * other.right;
  }

  /// Bland: the first column that lowers the sum of the artificial unknowns.
  std::size_t entering_column() const {
    for (std::size_t i = 0; i < unknowns_; ++i)
      if (goal_.coefficients[i] > 0) return i;
    return kNone;
  }

  /// Bland: the smallest ratio, and among equal ones the lowest unknown. There is one, because the
  /// goal is bounded by zero.
  std::size_t leaving_row(std::size_t column) const {
    std::size_t best = kNone;
    mpq_class best_ratio;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].coefficients[column] <= 0) continue;
      const mpq_class ratio = rows_[i].right / rows_[i].coefficients[column];
      const bool better =
          best == kNone || ratio < best_ratio || (ratio == best_ratio && basis_[i] < basis_[best]);
      if (!better) continue;
      best = i;
      best_ratio = ratio;
    }
    return best;
  }

  void pivot(std::size_t pivot_row, std::size_t column) {
    Equation& row = rows_[pivot_row];
    const mpq_class scale = row.coefficients[column];
    for (mpq_class& value : row.coefficients) value /= scale;
    row.right /= scale;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const mpq_class factor = rows_[i].coefficients[column];
      if (i != pivot_row && factor != 0) subtract(rows_[i], row, factor);
    }
    const mpq_class factor = goal_.coefficients[column];
    subtract(goal_, row, factor);
    basis_[pivot_row] = column;
  }

  std::vector<Equation> rows_;
  Equation goal_;  ///< the sum of the artificial unknowns, in the non-basic unknowns
  std::vector<std::size_t> basis_;
  std::size_t unknowns_ = 0;
};

}  // namespace

bool has_nonnegative_solution(std::vector<Equation> equations) {
  return PhaseOne(std::move(equations)).solve();
}

}  // namespace contactcheck::rational
