// Words of a line of text, and whole numbers among them. For the .cpp files of this folder alone.
#pragma once

#include <charconv>
#include <cstddef>
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

}  // namespace contactcheck::text
