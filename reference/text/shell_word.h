// Words of command lines that people copy.
#pragma once

#include <string>
#include <vector>

namespace contactcheck::text {

/// `word` as a shell takes it for one word: quoted where it has to be.
std::string in_shell(const std::string& word);

/// The words that a shell sees in `command`: quotes and backslashes keep blanks within a word.
/// Nothing is expanded, and operators are words like others. A quote that is not closed ends with
/// the text.
std::vector<std::string> shell_words(const std::string& command);

}  // namespace contactcheck::text
