// The words of the programs in this folder: whole numbers by name.
#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

namespace contactcheck::test {

struct SeedArguments {
  std::uint64_t seed = 1, count = std::numeric_limits<std::uint64_t>::max(), seconds = 10;
};

/// "--seed N", "--seconds N" and the count, which has a name of its own; false for anything else.
inline bool parse(int argc, char** argv, std::string_view count_name, SeedArguments& out) {
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    std::uint64_t* value = name == "--seed"      ? &out.seed
                           : name == count_name  ? &out.count
                           : name == "--seconds" ? &out.seconds
                                                 : nullptr;
    if (value == nullptr || i + 1 == argc) return false;
    const char* end = argv[i + 1] + std::strlen(argv[i + 1]);
    const auto [rest, error] = std::from_chars(argv[i + 1], end, *value);
    if (error != std::errc() || rest != end) return false;
  }
  return true;
}

}  // namespace contactcheck::test
