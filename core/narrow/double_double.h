// Numbers of about 106 bits: the unevaluated sum of two doubles.
//
// Source: error-free sums and products by Knuth, Dekker and Veltkamp; the algorithms and their
// bounds are AccurateDWPlusDW and DWTimesDW of Joldes, Muller and Popescu, "Tight and rigorous
// error bounds for basic building blocks of double-word arithmetic" (ACM TOMS 44, 2017): relative
// errors of at most 3 v^2 + 13 v^3 and 8 v^2 for v = 2^-53, so kDoubleDoubleError bounds both.
#pragma once

namespace contactcheck {

inline constexpr double kDoubleDoubleError = 0x1p-103;

/// high + low, |low| at most half a unit in the last place of high.
/// @pre magnitudes below 2^990, and products above 2^-900 or zero where errors are to hold
struct DoubleDouble {
  double high = 0, low = 0;

  DoubleDouble() = default;
  DoubleDouble(double value)
      : high(value) {}  // NOLINT(google-explicit-constructor): every double is one
  DoubleDouble(double h, double l) : high(h), low(l) {}

  /// a + b, exactly.
  static DoubleDouble sum(double a, double b) {
    const double s = a + b;
    const double from_b = s - a;
    return {s, (a - (s - from_b)) + (b - from_b)};
  }

  /// a * b, exactly unless it underflows.
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
    const auto [a_high, a_low] = halves(a);
    const auto [b_high, b_low] = halves(b);
    return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
  }

  DoubleDouble operator-() const { return {-high, -low}; }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble s = sum(a.high, b.high);
    const DoubleDouble t = sum(a.low, b.low);
    const DoubleDouble v = renormalised(s.high, s.low + t.high);
    return renormalised(v.high, t.low + v.low);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = product(a.high, b.high);
    return renormalised(p.high, p.low + (a.high * b.low + a.low * b.high));
  }

 private:
  /// The sum of two numbers of which the first is the larger one, or zero.
  static DoubleDouble renormalised(double larger, double smaller) {
    const double s = larger + smaller;
    return {s, smaller - (s - larger)};
  }
  /// a as a sum of two numbers of 26 bits.
  static DoubleDouble halves(double a) {
    const double scaled = 134217729.0 * a;  // 2^27 + 1
    const double high = scaled - (scaled - a);
    return {high, a - high};
  }
};

}  // namespace contactcheck
