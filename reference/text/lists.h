// Lists in sentences.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace contactcheck::text {

/// "a, b, c": the texts that `word` gives for each element.
template <typename List, typename Word>
  requires(!std::is_convertible_v<Word, std::string>)
std::string joined(const List& list, const Word& word, const std::string& between = ", ") {
  std::string out;
  bool first = true;
  for (const auto& element : list) {
    if (!first) out += between;
    out += word(element);
    first = false;
  }
  return out;
}

inline std::string joined(const std::vector<std::string>& words,
                          const std::string& between = ", ") {
  return joined(
      words, [](const std::string& word) { return word; }, between);
}

/// The first `most`, joined.
inline std::string first_joined(const std::vector<std::string>& words, std::size_t most) {
  const auto end = words.begin() + static_cast<std::ptrdiff_t>(std::min(most, words.size()));
  return joined(std::vector<std::string>(words.begin(), end));
}

/// "a, b and 3 more": the first `most`, joined, and the number of the others.
inline std::string shortened(const std::vector<std::string>& words, std::size_t most) {
  return first_joined(words, most) +
         (words.size() > most ? " and " + std::to_string(words.size() - most) + " more" : "");
}

}  // namespace contactcheck::text
