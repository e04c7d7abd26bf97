#include "reference/mesh/text_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "reference/text/file_text.h"

namespace contactcheck::mesh {
namespace {

bool ends_line(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// For a number out of Real's range: true if it is too small and rounds to 0, which is so exactly if
// its first digit other than 0 stands for less than 1.
bool is_tiny(std::string_view digits) {
  const std::size_t exponent_at = std::min(digits.find_first_of("eE"), digits.size());
  const std::string_view mantissa = digits.substr(0, exponent_at);
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return true;
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  // A power of ten; texts are far shorter than 2^53 bytes.
  const double power = static_cast<double>(point) - static_cast<double>(first);
  double exponent = 0.0;
  for (std::size_t i = exponent_at + 1; i < digits.size(); ++i)
    if (is_digit(digits[i])) exponent = std::min(10.0 * exponent + (digits[i] - '0'), 0x1p62);
  const bool negative = exponent_at + 1 < digits.size() && digits[exponent_at + 1] == '-';
  return power + (negative ? -exponent : exponent) < 0.0;
}

}  // namespace

TextCursor::TextCursor(std::string_view text, Rule rule)
    : text_(text),
      comments_(rule != Rule::kPlain),
      continued_(rule == Rule::kHashCommentsContinued) {
  if (text.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

// Where the line ends of which only blanks are left at `at`; npos if it has more.
std::size_t TextCursor::end_of_blanks(std::size_t at) const {
  while (at < text_.size() && is_blank(text_[at])) ++at;
  return at == text_.size() || ends_line(text_[at]) ? at : std::string_view::npos;
}

// Leaves the cursor on a word, or where the line ends.
bool TextCursor::at_end_of_line() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (comments_ && c == '#') {
      while (at_ < text_.size() && !ends_line(text_[at_])) ++at_;
      return true;
    } else if (continued_ && c == '\\') {
      const std::size_t end = end_of_blanks(at_ + 1);
      if (end == std::string_view::npos) return false;
      at_ = end;
      if (at_ < text_.size()) skip_line_end();
    } else {
      return ends_line(c);
    }
  }
  return true;
}

void TextCursor::skip_line_end() {
  at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
  ++line_;
}

std::string_view TextCursor::word_of_line() {
  if (at_end_of_line()) return {};
  const std::size_t begin = at_;
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_blank(c) || ends_line(c)) break;
    // "1.#QNAN" is one word: the NaN of some runtime libraries, and no comment behind a 1.
    if (comments_ && c == '#' && text_[at_ - 1] != '.') break;
    if (continued_ && c == '\\' && end_of_blanks(at_ + 1) != std::string_view::npos) break;
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

std::string_view TextCursor::word() {
  std::string_view out = word_of_line();
  while (out.empty() && next_line()) out = word_of_line();
  return out;
}

std::string_view TextCursor::rest_of_line() {
  if (at_end_of_line()) return {};
  const std::size_t begin = at_;
  std::size_t end = at_;
  while (!word_of_line().empty()) end = at_;
  return text_.substr(begin, end - begin);
}

bool TextCursor::next_line() {
  while (!at_end_of_line()) word_of_line();
  if (at_ == text_.size()) return false;
  skip_line_end();
  return true;
}

template <typename Real>
std::optional<Real> decimal(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  const std::size_t digit = word.starts_with('-') ? 1 : 0;
  // "nan", "inf" and their like are numbers to from_chars.
  if (digit == word.size() || (!is_digit(word[digit]) && word[digit] != '.')) return std::nullopt;
  Real value = 0;
  const auto read_all = [&value](std::string_view digits) {
    const char* const end = digits.data() + digits.size();
    const std::from_chars_result read = std::from_chars(digits.data(), end, value);
    if (read.ptr != end || read.ec == std::errc::invalid_argument) return false;
    if (read.ec == std::errc()) return true;
    value = digits.starts_with('-') ? Real(-0.0) : Real(0.0);
    return is_tiny(digits.substr(digits.starts_with('-') ? 1 : 0));
  };
  if (read_all(word)) return value;
  const std::size_t fortran = word.find_first_of("dD");
  if (fortran == std::string_view::npos) return std::nullopt;
  std::string digits(word);
  digits[fortran] = 'e';
  return read_all(digits) ? std::optional(value) : std::nullopt;
}

template std::optional<float> decimal(std::string_view word);
template std::optional<double> decimal(std::string_view word);

bool looks_like_a_number(std::string_view word) {
  while (!word.empty() && (word[0] == '+' || word[0] == '-')) word.remove_prefix(1);
  if (word.empty()) return false;
  if (is_digit(word[0]) || word[0] == '.') return true;
  const auto begins_with = [&](std::string_view name) {
    return word.size() >= name.size() &&
           std::equal(name.begin(), name.end(), word.begin(),
                      [](char a, char b) { return a == b || a == b + ('a' - 'A'); });
  };
  return begins_with("nan") || begins_with("inf");
}

std::string quoted_word(std::string_view word) { return text::in_quotes(std::string(word), 40); }

std::string coordinate_fault(std::string_view word) {
  return " has the coordinate " + quoted_word(word) + "; coordinates must be finite numbers";
}

std::string coordinate_fault(double value) {
  return coordinate_fault(std::string_view(std::isnan(value) ? "nan" : "inf"));
}

std::string names_no_vertex(std::int64_t index, std::size_t vertices) {
  return "names the vertex " + std::to_string(index) + "; the file has " +
         std::to_string(vertices) + ", counted from 0";
}

}  // namespace contactcheck::mesh
