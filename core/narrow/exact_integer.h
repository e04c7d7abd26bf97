// Signed integers wide enough to evaluate a determinant of doubles without any rounding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace contactcheck {

/// Exponent e such that value = odd integer * 2^e. @pre value finite and not zero
int lowest_bit_exponent(double value);

/// A signed integer of up to kMaxLimbs * 64 bits, without heap allocation; sign and magnitude.
/// Wide enough for every 3x3 determinant of differences of finite doubles: such a coordinate,
/// divided by 2^-1074, is below 2^2098, a difference below 2^2099, a 2x2 minor below 2^4199, a
/// product of both below 2^6298 and the sum of three below 2^6300, that is 99 limbs. A result that
/// does not fit aborts; it is never cut.
class ExactInteger {
 public:
  static constexpr std::size_t kMaxLimbs = 100;

  /// Zero.
  ExactInteger() = default;
  ExactInteger(const ExactInteger& other) { *this = other; }
  ExactInteger& operator=(const ExactInteger& other);

  /// value / 2^exponent, exactly.
  /// @pre value finite; value is zero or exponent <= lowest_bit_exponent(value)
  static ExactInteger from_double(double value, int exponent);

  /// -1, 0 or +1.
  int sign() const { return size_ == 0 ? 0 : (negative_ ? -1 : 1); }

  ExactInteger operator-() const;
  friend ExactInteger operator+(const ExactInteger& a, const ExactInteger& b);
  friend ExactInteger operator-(const ExactInteger& a, const ExactInteger& b);
  friend ExactInteger operator*(const ExactInteger& a, const ExactInteger& b);

 private:
  static int compare_magnitudes(const ExactInteger& a, const ExactInteger& b);
  static ExactInteger add_magnitudes(const ExactInteger& a, const ExactInteger& b);
  static ExactInteger subtract_magnitudes(const ExactInteger& larger, const ExactInteger& smaller);
  void push(std::uint64_t limb);
  void strip_leading_zeros();

  /// Little endian; only the first size_ limbs are set, and the last of them is not zero.
  std::array<std::uint64_t, kMaxLimbs> limbs_;
  std::size_t size_ = 0;
  bool negative_ = false;
};

}  // namespace contactcheck
