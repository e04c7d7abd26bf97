#include "core/types/suggestion.h"

#include <algorithm>

namespace contactcheck {
namespace {

constexpr std::size_t kMost = 3;  // names

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// Optimal string alignment.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = above;
    above = row;
  }
  return above[b.size()];
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  if (word.empty()) return "";
  std::vector<std::string> found;
  for (const std::string& name : names)
    if (name.starts_with(lower(word) + '-')) found.push_back(name);
  if (found.empty()) {
    std::size_t fewest = word.size() / 3;
    for (const std::string& name : names) {
      // The difference of the lengths is a lower bound of the number of edits.
      const std::size_t longer = std::max(name.size(), word.size()),
                        shorter = std::min(name.size(), word.size());
      if (longer - shorter > fewest) continue;
      const std::size_t count = edits(lower(word), lower(name));
      if (count > fewest) continue;
      if (count < fewest) found.clear();
      fewest = count;
      found.push_back(name);
    }
  }
  if (found.empty()) return "";
  if (found.size() > kMost) found.resize(kMost);
  std::string out = "did you mean ";
  for (std::size_t i = 0; i < found.size(); ++i)
    out += (i == 0 ? "" : i + 1 == found.size() ? " or " : ", ") + found[i];
  return out + "? ";
}

}  // namespace contactcheck
