// Little-endian bytes of the recording format: appending, and reading with every bound checked
// before anything is allocated.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "core/types/hash.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Strings and arrays end at a multiple of this many bytes, so that a reader may map doubles in
/// place.
inline constexpr std::size_t kRecordingAlignment = 8;

inline std::uint64_t fnv1a(std::string_view bytes) {
  Fnv1a hash;
  hash.bytes(bytes.data(), bytes.size());
  return hash.digest();
}

/// Appends values in little-endian order whatever the machine's own order is.
class ByteWriter {
 public:
  void u32(std::uint32_t value) { integer(value, 4); }
  void u64(std::uint64_t value) { integer(value, 8); }
  void f64(double value) { u64(std::bit_cast<std::uint64_t>(value)); }
  void raw(std::string_view bytes) { bytes_.append(bytes); }
  void text(std::string_view value) {
    u64(value.size());
    raw(value);
    pad();
  }
  void points(const std::vector<Vec3>& values) {
    for (const Vec3& p : values)
      for (int k = 0; k < 3; ++k) f64(p[k]);
  }
  void doubles(const std::vector<double>& values) {
    for (double value : values) f64(value);
  }
  void u32s(const std::vector<std::uint32_t>& values) {
    for (std::uint32_t value : values) u32(value);
    pad();
  }
  template <std::size_t N>
  void u32_rows(const std::vector<std::array<std::uint32_t, N>>& rows) {
    for (const auto& row : rows)
      for (std::uint32_t value : row) u32(value);
    pad();
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void integer(std::uint64_t value, int size) {
    std::array<char, 8> out;
    for (int i = 0; i < size; ++i) out[i] = static_cast<char>(value >> (8 * i) & 0xff);
    bytes_.append(out.data(), size);
  }
  void pad() { bytes_.resize((bytes_.size() + 7) / kRecordingAlignment * kRecordingAlignment); }

  std::string bytes_;
};

/// Reads what ByteWriter wrote. Every failure throws InputError: file, what, and the byte where.
/// Allocates nothing that the remaining bytes could not fill.
class ByteReader {
 public:
  /// @pre `bytes` outlive the reader; `file` is used in messages only
  ByteReader(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  std::size_t position() const { return position_; }
  std::size_t remaining() const { return bytes_.size() - position_; }
  std::string_view bytes() const { return bytes_; }

  [[noreturn]] void fail(const std::string& what, std::size_t where) const {
    throw InputError("recording \"" + file_ + "\": " + what + " (at byte " + std::to_string(where) +
                     ").");
  }
  [[noreturn]] void fail(const std::string& what) const { fail(what, position_); }

  std::string_view take(std::size_t size, const char* what) {
    if (size > remaining()) fail(std::string("the file ends within the ") + what);
    const std::string_view out = bytes_.substr(position_, size);
    position_ += size;
    return out;
  }
  std::uint32_t u32(const char* what) { return static_cast<std::uint32_t>(integer(4, what)); }
  std::uint64_t u64(const char* what) { return integer(8, what); }

  double f64(const char* what) {
    const std::size_t where = position_;
    const double value = std::bit_cast<double>(u64(what));
    if (!(value - value == 0.0)) fail(std::string("not a finite number in the ") + what, where);
    return value;
  }

  /// A number of elements of `element_size` bytes each, which must fit into the rest of the file
  /// and be numbered by 32 bits.
  std::size_t count(const char* what, std::size_t element_size) {
    const std::size_t where = position_;
    const std::uint64_t value = u64(what);
    if (value > UINT32_MAX - 1 || value > remaining() / element_size) {
      fail("the number of " + std::string(what) + " is " + std::to_string(value) +
               ", more than the file can hold",
           where);
    }
    return static_cast<std::size_t>(value);
  }

  std::string text(const char* what) {
    const std::size_t size = count(what, 1);
    std::string out(take(size, what));
    padding(what);
    return out;
  }
  std::vector<Vec3> points(std::size_t size, const char* what) {
    need(size, 24, what);
    std::vector<Vec3> out(size);
    for (Vec3& p : out)
      for (int k = 0; k < 3; ++k) p[k] = f64(what);
    return out;
  }
  std::vector<double> doubles(std::size_t size, const char* what) {
    need(size, 8, what);
    std::vector<double> out(size);
    for (double& value : out) value = f64(what);
    return out;
  }
  std::vector<std::uint32_t> u32s(std::size_t size, const char* what) {
    need(size, 4, what);
    std::vector<std::uint32_t> out(size);
    for (std::uint32_t& value : out) value = u32(what);
    padding(what);
    return out;
  }
  template <std::size_t N>
  std::vector<std::array<std::uint32_t, N>> u32_rows(std::size_t size, const char* what) {
    need(size, 4 * N, what);
    std::vector<std::array<std::uint32_t, N>> out(size);
    for (auto& row : out)
      for (std::uint32_t& value : row) value = u32(what);
    padding(what);
    return out;
  }

 private:
  void need(std::size_t size, std::size_t element_size, const char* what) const {
    if (size > remaining() / element_size) fail(std::string("the file ends within the ") + what);
  }
  std::uint64_t integer(std::size_t size, const char* what) {
    const std::string_view in = take(size, what);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(in[i])) << (8 * i);
    return value;
  }
  void padding(const char* what) {
    const std::size_t where = position_;
    while (position_ % kRecordingAlignment != 0) {
      if (take(1, what)[0] != 0)
        fail(std::string("bytes other than zero after the ") + what, where);
    }
  }

  std::string_view bytes_;
  std::string file_;
  std::size_t position_ = 0;
};

}  // namespace contactcheck
