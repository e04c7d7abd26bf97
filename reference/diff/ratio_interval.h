// A ratio that was measured, with how sure it is; and what dividing two of them gives.
#pragma once

namespace contactcheck {

/// A ratio with its 95 % interval.
struct RatioInterval {
  double value = 1.0, low = 1.0, high = 1.0;
};

/// numerator / denominator. The two were measured apart, so their errors are independent: the
/// half-widths of their intervals, as logarithms, add up in squares, for either end apart.
/// @pre all values and ends above 0
RatioInterval quotient(const RatioInterval& numerator, const RatioInterval& denominator);

}  // namespace contactcheck
