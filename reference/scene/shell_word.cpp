#include "reference/scene/shell_word.h"

#include <algorithm>
#include <cctype>

namespace contactcheck {
namespace {

bool is_plain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) ||
         std::string("_@%+=:,./-").find(c) != std::string::npos;
}

}  // namespace

std::string in_shell(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace contactcheck
