// Reads the words of a text mesh file, line by line; all its numbers are read here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace contactcheck::mesh {

/// Reads a text once, forwards. Lines end with LF, CR or both; words are separated by blanks, tabs
/// and other white space; a byte-order mark at the beginning is skipped.
class TextCursor {
 public:
  enum class Rule : std::uint8_t {
    kPlain,
    kHashComments,           ///< '#' ends a line: OFF
    kHashCommentsContinued,  ///< and a line whose last word ends in '\' continues in the next: OBJ
  };
  explicit TextCursor(std::string_view text, Rule rule = Rule::kPlain);

  /// The next word of this line; empty at its end.
  std::string_view word_of_line();
  /// The next word on any line; empty at the end of the text.
  std::string_view word();
  /// The rest of this line, without white space (or a comment) around it.
  std::string_view rest_of_line();
  /// Skips the rest of this line. False at the end of the text.
  bool next_line();

  /// The line of the last word, from 1.
  std::size_t line() const { return line_; }
  /// The offset of the next byte.
  std::size_t offset() const { return at_; }

 private:
  std::size_t end_of_blanks(std::size_t at) const;
  bool at_end_of_line();
  void skip_line_end();

  std::string_view text_;
  bool comments_, continued_;
  std::size_t at_ = 0, line_ = 1;
};

/// The double or float nearest to a decimal number, in C's or Fortran's notation ("-1.5", "2e3",
/// "2.0D+01"), that is the whole word. Nothing for other words, for "nan" and "inf", and on
/// overflow.
template <typename Real>
std::optional<Real> decimal(std::string_view word);

/// True if the word is a number or denotes none ("nan", "-1.#IND", "inf"): enough for values that
/// are not used.
bool looks_like_a_number(std::string_view word);

/// The word in quotes for a message, cut after 40 bytes.
std::string quoted_word(std::string_view word);
/// The end of a sentence about a coordinate: ` has the coordinate "9,5"; coordinates must be finite
/// numbers`.
std::string coordinate_fault(std::string_view word);
/// The same for a NaN or an infinity in a binary file.
std::string coordinate_fault(double value);
/// "names the vertex 9; the file has 4, counted from 0"
std::string names_no_vertex(std::int64_t index, std::size_t vertices);

}  // namespace contactcheck::mesh
