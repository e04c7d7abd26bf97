// Words of a text or of bytes, and the numbers among them. For .cpp files alone.
#pragma once

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace contactcheck::text {

inline std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

/// Nothing unless all of the word is a number of the type.
template <typename Integer>
std::optional<Integer> whole_number(std::string_view word) {
  Integer value = 0;
  const char* end = word.data() + word.size();
  const std::from_chars_result read = std::from_chars(word.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

/// At most 8 bytes of a binary file as a whole number.
inline std::uint64_t whole_of_bytes(std::string_view bytes, std::endian order) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t place = order == std::endian::big ? i : bytes.size() - 1 - i;
    value = value << 8 | static_cast<unsigned char>(bytes[place]);
  }
  return value;
}

inline char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Lowers ASCII letters; other bytes stay.
inline std::string lower_case(std::string text) {
  for (char& c : text) c = lower_case(c);
  return text;
}

/// ".obj" of "Ball.OBJ"
inline std::string lower_extension(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace contactcheck::text
