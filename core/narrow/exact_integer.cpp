#include "core/narrow/exact_integer.h"

#include <algorithm>
#include <bit>
#include <utility>

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

template <std::size_t kInline, std::size_t kLargest>
std::uint64_t* LimbInteger<kInline, kLargest>::resize(std::size_t size) {
  CONTACTCHECK_INVARIANT(size <= kLargest, "exact integer wider than any predicate needs");
  heap_.reset(size > kInline ? new std::uint64_t[size] : nullptr);
  size_ = size;
  return limbs();
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest>& LimbInteger<kInline, kLargest>::operator=(
    const LimbInteger& other) {
  if (this == &other) return *this;
  std::copy_n(other.limbs(), other.size_, resize(other.size_));
  negative_ = other.negative_;
  return *this;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest>& LimbInteger<kInline, kLargest>::operator=(
    LimbInteger&& other) noexcept {
  if (this == &other) return *this;
  heap_ = std::move(other.heap_);
  size_ = std::exchange(other.size_, 0);
  negative_ = std::exchange(other.negative_, false);
  if (!heap_) std::copy_n(other.inline_.begin(), size_, inline_.begin());
  return *this;
}

template <std::size_t kInline, std::size_t kLargest>
void LimbInteger<kInline, kLargest>::strip_leading_zeros() {
  const std::uint64_t* limb = limbs();
  while (size_ > 0 && limb[size_ - 1] == 0) --size_;
  if (size_ == 0) negative_ = false;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest> LimbInteger<kInline, kLargest>::from_unsigned(std::uint64_t value) {
  LimbInteger result;
  if (value != 0) *result.resize(1) = value;
  return result;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest> LimbInteger<kInline, kLargest>::from_double(double value,
                                                                           int exponent) {
  LimbInteger result;
  auto [mantissa, own_exponent] = decompose(value);
  if (mantissa == 0) return result;
  const int trailing = std::countr_zero(mantissa);
  mantissa >>= trailing;
  const int shift = own_exponent + trailing - exponent;
  CONTACTCHECK_INVARIANT(shift >= 0, "exponent above the lowest bit of the value");
  const auto zeros = static_cast<std::size_t>(shift / 64);
  const Wide shifted = static_cast<Wide>(mantissa) << (shift % 64);
  std::uint64_t* limb = result.resize(zeros + 2);
  std::fill_n(limb, zeros, 0);
  limb[zeros] = static_cast<std::uint64_t>(shifted);
  limb[zeros + 1] = static_cast<std::uint64_t>(shifted >> 64);
  result.strip_leading_zeros();
  result.negative_ = std::bit_cast<std::uint64_t>(value) >> 63;
  return result;
}

template <std::size_t kInline, std::size_t kLargest>
int LimbInteger<kInline, kLargest>::compare_magnitudes(const LimbInteger& a, const LimbInteger& b) {
  if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
  for (std::size_t i = a.size_; i-- > 0;)
    if (a.limbs()[i] != b.limbs()[i]) return a.limbs()[i] < b.limbs()[i] ? -1 : 1;
  return 0;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest> LimbInteger<kInline, kLargest>::add_magnitudes(
    const LimbInteger& a, const LimbInteger& b) {
  const LimbInteger& longer = a.size_ >= b.size_ ? a : b;
  const LimbInteger& shorter = a.size_ >= b.size_ ? b : a;
  LimbInteger total;
  // A carry out of the longest limb needs one more; it is asked for only where it may be needed, so
  // that the widest sums still fit.
  const bool may_carry =
      longer.size_ > 0 &&
      ~longer.limbs()[longer.size_ - 1] <=
          (shorter.size_ == longer.size_ ? shorter.limbs()[shorter.size_ - 1] : std::uint64_t{0});
  std::uint64_t* limb = total.resize(longer.size_ + (may_carry ? 1 : 0));
  Wide carry = 0;
  for (std::size_t i = 0; i < longer.size_; ++i) {
    carry += longer.limbs()[i];
    if (i < shorter.size_) carry += shorter.limbs()[i];
    limb[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  if (may_carry) limb[longer.size_] = static_cast<std::uint64_t>(carry);
  total.strip_leading_zeros();
  return total;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest> LimbInteger<kInline, kLargest>::subtract_magnitudes(
    const LimbInteger& larger, const LimbInteger& smaller) {
  LimbInteger difference;
  std::uint64_t* limb = difference.resize(larger.size_);
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < larger.size_; ++i) {
    const Wide taken = static_cast<Wide>(i < smaller.size_ ? smaller.limbs()[i] : 0) + borrow;
    borrow = taken > larger.limbs()[i] ? 1 : 0;
    limb[i] = larger.limbs()[i] - static_cast<std::uint64_t>(taken);
  }
  difference.strip_leading_zeros();
  return difference;
}

template <std::size_t kInline, std::size_t kLargest>
double LimbInteger<kInline, kLargest>::scaled(std::size_t limbs_in_all) const {
  // Two limbs have all that a double can hold, and what is 16 limbs below is nothing beside it.
  double value = 0, unit = 1;
  for (std::size_t i = limbs_in_all; i > 0 && limbs_in_all - i < 16; --i) {
    unit *= 0x1p-64;
    if (i <= size_) value += static_cast<double>(limbs()[i - 1]) * unit;
  }
  return negative_ ? -value : value;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest> LimbInteger<kInline, kLargest>::operator-() const {
  LimbInteger result = *this;
  result.negative_ = size_ > 0 && !negative_;
  return result;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest> LimbInteger<kInline, kLargest>::sum(const LimbInteger& a,
                                                                   const LimbInteger& b,
                                                                   bool b_negative) {
  LimbInteger result;
  if (a.negative_ == b_negative) {
    result = add_magnitudes(a, b);
    result.negative_ = result.size_ > 0 && b_negative;
  } else {
    const bool a_leads = compare_magnitudes(a, b) >= 0;
    result = a_leads ? subtract_magnitudes(a, b) : subtract_magnitudes(b, a);
    result.negative_ = result.size_ > 0 && (a_leads ? a.negative_ : b_negative);
  }
  return result;
}

template <std::size_t kInline, std::size_t kLargest>
LimbInteger<kInline, kLargest> LimbInteger<kInline, kLargest>::product(const LimbInteger& a,
                                                                       const LimbInteger& b) {
  LimbInteger result;
  if (a.size_ == 0 || b.size_ == 0) return result;
  std::uint64_t* limb = result.resize(a.size_ + b.size_);
  std::fill_n(limb, b.size_, 0);
  const std::uint64_t* a_limb = a.limbs();
  const std::uint64_t* b_limb = b.limbs();
  for (std::size_t i = 0; i < a.size_; ++i) {
    Wide carry = 0;
    for (std::size_t j = 0; j < b.size_; ++j) {
      // (2^64-1)^2 + 2 (2^64-1) = 2^128 - 1: product, old limb and carry always fit.
      carry += static_cast<Wide>(a_limb[i]) * b_limb[j] + limb[i + j];
      limb[i + j] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    limb[i + b.size_] = static_cast<std::uint64_t>(carry);
  }
  result.strip_leading_zeros();
  result.negative_ = result.size_ > 0 && a.negative_ != b.negative_;
  return result;
}

template class LimbInteger<100, 100>;
template class LimbInteger<24, 3552>;

}  // namespace contactcheck
