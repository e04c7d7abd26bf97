// Makes text from detectors fit for a row: libraries print arbitrary bytes, JSON takes only UTF-8.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace contactcheck::text {

constexpr std::size_t kLongestForeignText = 400;  ///< bytes that are kept of one text

/// The first line of `text` that is not blank, without control characters, every byte that is no
/// UTF-8 as '?', cut between characters to at most `longest` bytes with "..." behind them.
std::string printable_line(std::string_view text, std::size_t longest = kLongestForeignText);

/// `text`; of a longer one "..." and its last `longest` bytes, without a part of a character.
std::string end_of(const std::string& text, std::size_t longest);

/// What the exception that is being handled says; of one that is no std::exception its type.
/// @pre called inside a catch clause
std::string current_exception_text();

}  // namespace contactcheck::text
