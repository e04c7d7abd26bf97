// Written from the description of the format, without the reader that it is to test.
#include "tests/fuzz/recording_repair.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace contactcheck::test {
namespace {

constexpr std::size_t kVersionAt = 8, kSizeAt = 16, kSceneAt = 32, kHashSize = 8;

std::uint64_t fnv1a_64(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

void put_u64(std::string& bytes, std::size_t at, std::uint64_t value) {
  for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i) & 0xff);
}

// Steps over the parts of a file. Beyond the end everything is empty, and `inside` false.
class Walk {
 public:
  Walk(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  std::size_t at() const { return at_; }
  bool inside() const { return inside_; }

  std::uint64_t u64() {
    const std::size_t begin = at_;
    skip(1, 8);
    std::uint64_t value = 0;
    for (std::size_t i = 0; inside_ && i < 8; ++i)
      value |= std::uint64_t{static_cast<unsigned char>(bytes_[begin + i])} << (8 * i);
    return value;
  }
  /// Elements of so many bytes, and the zeros up to a multiple of 8 after them.
  void skip(std::uint64_t count, std::size_t size) {
    inside_ = inside_ && count <= (bytes_.size() - at_) / size;
    if (!inside_) return;
    at_ += static_cast<std::size_t>(count) * size;
    at_ += (8 - at_ % 8) % 8;
    inside_ = at_ <= bytes_.size();
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
  bool inside_ = true;
};

void skip_lattice(Walk& walk, std::uint64_t vertices, std::uint64_t triangles) {
  for (int axis = 0; axis < 3; ++axis) walk.skip(walk.u64(), 8);
  const std::uint64_t cells = walk.u64();
  walk.skip(cells, 12);
  walk.skip(walk.u64(), 12);
  walk.skip(cells, 32);
  walk.skip(vertices, 4);
  walk.skip(vertices, 24);
  walk.skip(triangles + 1, 4);
  walk.skip(walk.u64(), 4);
}

// From after the key.
void skip_shape(Walk& walk) {
  const std::uint64_t vertices = walk.u64();
  walk.skip(vertices, 24);
  const std::uint64_t triangles = walk.u64();
  walk.skip(triangles, 12);
  if (walk.u64() == 1) skip_lattice(walk, vertices, triangles);
}

void repair_shapes(std::string& bytes) {
  Walk walk(std::string_view(bytes).substr(0, bytes.size() - kHashSize), kSceneAt);
  walk.skip(walk.u64(), 1);
  for (std::uint64_t left = walk.u64(); left > 0 && walk.inside(); --left) {
    const std::size_t key = walk.at();
    walk.u64();
    const std::size_t begin = walk.at();
    skip_shape(walk);
    if (!walk.inside()) return;
    put_u64(bytes, key, fnv1a_64(std::string_view(bytes).substr(begin, walk.at() - begin)));
  }
}

}  // namespace

std::string repaired_recording(std::string bytes) {
  constexpr std::string_view kMagic("\x89\x43\x43\x52\r\n\x1a\n", kVersionAt);
  bytes.replace(0, kMagic.size(), kMagic);
  put_u64(bytes, kVersionAt, 1);
  put_u64(bytes, kSizeAt, bytes.size());
  repair_shapes(bytes);
  const std::size_t content = bytes.size() - kHashSize;
  put_u64(bytes, content, fnv1a_64(std::string_view(bytes).substr(0, content)));
  return bytes;
}

}  // namespace contactcheck::test
