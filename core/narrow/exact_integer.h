// Signed integers wide enough to evaluate polynomials of doubles without any rounding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace contactcheck {

/// Exponent e such that value = odd integer * 2^e. @pre value finite and not zero
int lowest_bit_exponent(double value);

/// A signed integer of at most kLargest limbs of 64 bits; sign and magnitude. The first kInline
/// limbs need no allocation. A result that does not fit aborts; it is never cut.
template <std::size_t kInline, std::size_t kLargest>
class LimbInteger {
 public:
  static_assert(kInline <= kLargest);
  static constexpr std::size_t kMaxLimbs = kLargest;

  /// Zero.
  LimbInteger() = default;
  LimbInteger(const LimbInteger& other) { *this = other; }
  LimbInteger(LimbInteger&& other) noexcept { *this = std::move(other); }
  LimbInteger& operator=(const LimbInteger& other);
  LimbInteger& operator=(LimbInteger&& other) noexcept;
  ~LimbInteger() = default;

  /// value / 2^exponent, exactly.
  /// @pre value finite; value is zero or exponent <= lowest_bit_exponent(value)
  static LimbInteger from_double(double value, int exponent);

  static LimbInteger from_unsigned(std::uint64_t value);

  /// -1, 0 or +1.
  int sign() const { return size_ == 0 ? 0 : (negative_ ? -1 : 1); }

  /// Limbs that are used; 0 of zero.
  std::size_t size() const { return size_; }
  /// About value / 2^(64 limbs): a guess without a bound. @pre size() <= limbs
  double scaled(std::size_t limbs) const;

  LimbInteger operator-() const;

  friend LimbInteger operator+(const LimbInteger& a, const LimbInteger& b) {
    return sum(a, b, b.negative_);
  }
  friend LimbInteger operator-(const LimbInteger& a, const LimbInteger& b) {
    return sum(a, b, !b.negative_);
  }
  friend LimbInteger operator*(const LimbInteger& a, const LimbInteger& b) { return product(a, b); }

 private:
  /// a + b, where b has the given sign instead of its own.
  static LimbInteger sum(const LimbInteger& a, const LimbInteger& b, bool b_negative);
  static LimbInteger product(const LimbInteger& a, const LimbInteger& b);
  static int compare_magnitudes(const LimbInteger& a, const LimbInteger& b);
  static LimbInteger add_magnitudes(const LimbInteger& a, const LimbInteger& b);
  static LimbInteger subtract_magnitudes(const LimbInteger& larger, const LimbInteger& smaller);

  const std::uint64_t* limbs() const { return heap_ ? heap_.get() : inline_.data(); }
  std::uint64_t* limbs() { return heap_ ? heap_.get() : inline_.data(); }
  /// Makes room for `size` limbs, whose values are then arbitrary.
  std::uint64_t* resize(std::size_t size);
  void strip_leading_zeros();

  /// Little endian, in heap_ if that is not null; only the first size_ limbs are set, and the last
  /// of them is not zero.
  std::array<std::uint64_t, kInline> inline_;
  std::unique_ptr<std::uint64_t[]> heap_;
  std::size_t size_ = 0;
  bool negative_ = false;
};

/// For every 3x3 determinant of differences of finite doubles: such a coordinate, divided by
/// 2^-1074, is below 2^2098, a difference below 2^2099, a 2x2 minor below 2^4199, a product of both
/// below 2^6298 and the sum of three below 2^6300, that is 99 limbs.
using ExactInteger = LimbInteger<100, 100>;

/// For signs of polynomials at roots of polynomials; impact_exact.cpp derives 3,549 limbs.
using WideInteger = LimbInteger<24, 3552>;

}  // namespace contactcheck
