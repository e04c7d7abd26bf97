#include "reference/text/shell_word.h"

#include <algorithm>
#include <cctype>

namespace contactcheck::text {
namespace {

// A backslash within double quotes stands for itself before any other character.
const std::string kEscapedInQuotes = "$`\"\\";

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

std::vector<std::string> shell_words(const std::string& command) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = '\0';
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == '\0' && std::isspace(static_cast<unsigned char>(c))) {
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    const bool opens = quote == '\0' && (c == '\'' || c == '"');
    if (opens || c == quote) {
      quote = opens ? c : '\0';
    } else if (c == '\\' && quote != '\'' && i + 1 < command.size() &&
               (quote == '\0' || kEscapedInQuotes.find(command[i + 1]) != std::string::npos)) {
      words.back() += command[++i];
    } else {
      words.back() += c;
    }
  }
  return words;
}

}  // namespace contactcheck::text
