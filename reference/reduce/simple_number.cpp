#include "reference/reduce/simple_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace contactcheck::reduce {
namespace {

constexpr int kBits = 53, kDigits = 17;  // of any double
constexpr int kPerBit = 2, kDecimal = 12, kPerDigit = 4;

/// whole * 2^exponent with an odd whole number.
struct Dyadic {
  std::uint64_t whole = 0;
  int exponent = 0;
};

/// @pre not 0
Dyadic dyadic_of(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(std::abs(value), &exponent);
  Dyadic out{static_cast<std::uint64_t>(std::ldexp(mantissa, kBits)), exponent - kBits};
  while (out.whole % 2 == 0) {
    out.whole /= 2;
    ++out.exponent;
  }
  return out;
}

/// Digits without zeros at either end, and the power of ten of the last one.
struct Decimal {
  int digits = 0, exponent = 0;
};

/// @pre not 0
Decimal decimal_of(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, std::abs(value),
                                 std::chars_format::scientific);  // "d.ddde-xx", shortest
  const std::string_view all(text, static_cast<std::size_t>(end.ptr - text));
  const std::size_t e = all.find('e');
  const std::string_view mantissa = all.substr(0, e);
  const auto digits = static_cast<int>(mantissa.size() > 1 ? mantissa.size() - 1 : 1);
  return {digits, std::atoi(std::string(all.substr(e + 1)).c_str()) - (digits - 1)};
}

double rounded(double value, int bits, double (*to_whole)(double)) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(to_whole(std::ldexp(mantissa, bits)), exponent - bits);
}

double to_nearest(double x) { return std::nearbyint(x); }
double down(double x) { return std::floor(x); }
double up(double x) { return std::ceil(x); }

}  // namespace

int complexity(double value) {
  if (value == 0.0) return 0;
  const Dyadic d = dyadic_of(value);
  const Decimal t = decimal_of(value);
  const int by_bits = kPerBit * significant_bits(value) + std::abs(d.exponent);
  const int by_digits = kDecimal + kPerDigit * t.digits + std::abs(t.exponent);
  return std::min(by_bits, by_digits) + (value < 0.0 ? 1 : 0);
}

int significant_bits(double value) {
  if (value == 0.0) return 0;
  int bits = 0;
  for (std::uint64_t whole = dyadic_of(value).whole; whole > 0; whole /= 2) ++bits;
  return bits;
}

int decimal_digits(double value) { return value == 0.0 ? 0 : decimal_of(value).digits; }

double rounded_to_bits(double value, int bits) { return rounded(value, bits, to_nearest); }

double rounded_to_digits(double value, int digits) {
  char text[64];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1);
  return std::strtod(std::string(text, end.ptr).c_str(), nullptr);
}

std::vector<double> simpler_numbers(double value) {
  std::vector<double> out = {
      0.0, 1.0, -1.0, 2.0, -2.0, std::nearbyint(value), std::floor(value), std::ceil(value)};
  for (int bits = 1; bits < kBits; ++bits) {
    out.push_back(rounded(value, bits, down));
    out.push_back(rounded(value, bits, up));
  }
  for (int digits = 1; digits < kDigits; ++digits) out.push_back(rounded_to_digits(value, digits));
  const int own = complexity(value);
  std::erase_if(out, [&](double x) { return !std::isfinite(x) || complexity(x) >= own; });
  for (double& x : out) x += 0.0;  // no minus before a zero
  std::stable_sort(out.begin(), out.end(), [](double a, double b) {
    const int ca = complexity(a), cb = complexity(b);
    return ca != cb ? ca < cb : a < b;
  });
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace contactcheck::reduce
