#include "core/narrow/exact_integer.h"

#include <algorithm>
#include <bit>

#include "core/types/check.h"

namespace contactcheck {
namespace {

// A limb product and its carries need 128 bits; both compilers of this project have the type.
__extension__ using Wide = unsigned __int128;

constexpr std::uint64_t kFractionMask = (std::uint64_t{1} << 52) - 1;

/// |value| = mantissa * 2^exponent. Read from the bits, so that no rounding or flush-to-zero mode
/// has a say.
struct Decomposed {
  std::uint64_t mantissa;
  int exponent;
};

Decomposed decompose(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  const std::uint64_t fraction = bits & kFractionMask;
  if (biased == 0) return {fraction, -1074};
  return {fraction | (std::uint64_t{1} << 52), biased - 1075};
}

}  // namespace

int lowest_bit_exponent(double value) {
  const Decomposed parts = decompose(value);
  CONTACTCHECK_DCHECK(parts.mantissa != 0);
  return parts.exponent + std::countr_zero(parts.mantissa);
}

ExactInteger& ExactInteger::operator=(const ExactInteger& other) {
  if (this == &other) return *this;
  std::copy_n(other.limbs_.begin(), other.size_, limbs_.begin());
  size_ = other.size_;
  negative_ = other.negative_;
  return *this;
}

void ExactInteger::push(std::uint64_t limb) {
  CONTACTCHECK_INVARIANT(size_ < kMaxLimbs, "exact integer wider than any predicate needs");
  limbs_[size_++] = limb;
}

void ExactInteger::strip_leading_zeros() {
  while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  if (size_ == 0) negative_ = false;
}

ExactInteger ExactInteger::from_double(double value, int exponent) {
  ExactInteger result;
  auto [mantissa, own_exponent] = decompose(value);
  if (mantissa == 0) return result;
  const int trailing = std::countr_zero(mantissa);
  mantissa >>= trailing;
  const int shift = own_exponent + trailing - exponent;
  CONTACTCHECK_INVARIANT(shift >= 0, "exponent above the lowest bit of the value");
  for (int i = 0; i < shift / 64; ++i) result.push(0);
  const Wide shifted = static_cast<Wide>(mantissa) << (shift % 64);
  result.push(static_cast<std::uint64_t>(shifted));
  if (shifted >> 64) result.push(static_cast<std::uint64_t>(shifted >> 64));
  result.negative_ = std::bit_cast<std::uint64_t>(value) >> 63;
  return result;
}

int ExactInteger::compare_magnitudes(const ExactInteger& a, const ExactInteger& b) {
  if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
  for (std::size_t i = a.size_; i-- > 0;)
    if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i] ? -1 : 1;
  return 0;
}

ExactInteger ExactInteger::add_magnitudes(const ExactInteger& a, const ExactInteger& b) {
  const ExactInteger& longer = a.size_ >= b.size_ ? a : b;
  const ExactInteger& shorter = a.size_ >= b.size_ ? b : a;
  ExactInteger sum;
  Wide carry = 0;
  for (std::size_t i = 0; i < longer.size_; ++i) {
    carry += longer.limbs_[i];
    if (i < shorter.size_) carry += shorter.limbs_[i];
    sum.push(static_cast<std::uint64_t>(carry));
    carry >>= 64;
  }
  if (carry) sum.push(static_cast<std::uint64_t>(carry));
  return sum;
}

ExactInteger ExactInteger::subtract_magnitudes(const ExactInteger& larger,
                                               const ExactInteger& smaller) {
  ExactInteger difference;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < larger.size_; ++i) {
    const Wide taken = static_cast<Wide>(i < smaller.size_ ? smaller.limbs_[i] : 0) + borrow;
    borrow = taken > larger.limbs_[i] ? 1 : 0;
    difference.push(larger.limbs_[i] - static_cast<std::uint64_t>(taken));
  }
  difference.strip_leading_zeros();
  return difference;
}

ExactInteger ExactInteger::operator-() const {
  ExactInteger result = *this;
  result.negative_ = size_ > 0 && !negative_;
  return result;
}

ExactInteger operator+(const ExactInteger& a, const ExactInteger& b) {
  const bool a_leads = ExactInteger::compare_magnitudes(a, b) >= 0;
  ExactInteger result;
  if (a.negative_ == b.negative_) {
    result = ExactInteger::add_magnitudes(a, b);
  } else {
    result =
        a_leads ? ExactInteger::subtract_magnitudes(a, b) : ExactInteger::subtract_magnitudes(b, a);
  }
  result.negative_ = result.size_ > 0 && (a_leads ? a : b).negative_;
  return result;
}

ExactInteger operator-(const ExactInteger& a, const ExactInteger& b) { return a + (-b); }

ExactInteger operator*(const ExactInteger& a, const ExactInteger& b) {
  ExactInteger product;
  if (a.size_ == 0 || b.size_ == 0) return product;
  for (std::size_t i = 0; i < a.size_ + b.size_; ++i) product.push(0);
  for (std::size_t i = 0; i < a.size_; ++i) {
    Wide carry = 0;
    for (std::size_t j = 0; j < b.size_; ++j) {
      // (2^64-1)^2 + 2 (2^64-1) = 2^128 - 1: product, old limb and carry always fit.
      carry += static_cast<Wide>(a.limbs_[i]) * b.limbs_[j] + product.limbs_[i + j];
      product.limbs_[i + j] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    product.limbs_[i + b.size_] = static_cast<std::uint64_t>(carry);
  }
  product.strip_leading_zeros();
  product.negative_ = product.size_ > 0 && a.negative_ != b.negative_;
  return product;
}

}  // namespace contactcheck
