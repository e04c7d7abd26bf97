#include "reference/diff/ratio_interval.h"

#include <cmath>

namespace contactcheck {
namespace {

// The logarithm of how far an end lies from the value.
double reach(double from, double to) { return std::abs(std::log(to / from)); }

}  // namespace

RatioInterval quotient(const RatioInterval& numerator, const RatioInterval& denominator) {
  const double value = numerator.value / denominator.value;
  const double down =
      std::hypot(reach(numerator.value, numerator.low), reach(denominator.value, denominator.high));
  const double up =
      std::hypot(reach(numerator.value, numerator.high), reach(denominator.value, denominator.low));
  return {value, value * std::exp(-down), value * std::exp(up)};
}

}  // namespace contactcheck
