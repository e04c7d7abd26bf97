// The words of a mesh file in text, line by line, and the one way in which its numbers are read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace contactcheck::mesh {

/// Goes through a text once. Lines end with LF, CR or both; words are parted by blanks, tabs and
/// other white space; a byte-order mark at the beginning is no word.
class TextCursor {
 public:
  enum class Rule : std::uint8_t {
    kPlain,
    kHashComments,           ///< '#' ends a line: OFF
    kHashCommentsContinued,  ///< and a line whose last word ends in '\' goes on in the next: OBJ
  };
  explicit TextCursor(std::string_view text, Rule rule = Rule::kPlain);

  /// The next word of this line; empty where it has no more.
  std::string_view word_of_line();
  /// The next word, on whatever line; empty at the end of the text.
  std::string_view word();
  /// What is left of this line, without white space (or a comment) around it.
  std::string_view rest_of_line();
  /// Leaves this line. False at the end of the text.
  bool next_line();

  /// Of the word read last, from 1.
  std::size_t line() const { return line_; }
  /// Where the next byte is read.
  std::size_t offset() const { return at_; }

 private:
  std::size_t end_of_blanks(std::size_t at) const;
  bool at_end_of_line();
  void skip_line_end();

  std::string_view text_;
  bool comments_, continued_;
  std::size_t at_ = 0, line_ = 1;
};

/// The double or float nearest to a decimal number that is all of the word, in C's or Fortran's
/// notation ("-1.5", "2e3", "2.0D+01"). Nothing for other words, "nan" and "inf" among them, and
/// for numbers that overflow.
template <typename Real>
std::optional<Real> decimal(std::string_view word);

/// Whether the word is a number or stands for none ("nan", "-1.#IND", "inf"): what a value may be
/// that nobody reads.
bool looks_like_a_number(std::string_view word);

/// The word in quotes for a message, cut after 40 bytes.
std::string quoted_word(std::string_view word);
/// The end of a sentence about a coordinate: ` has the coordinate "9,5"; coordinates must be finite
/// numbers`.
std::string coordinate_fault(std::string_view word);
/// The same of a NaN or an infinity in a binary file.
std::string coordinate_fault(double value);
/// "names the vertex 9; the file has 4, counted from 0"
std::string names_no_vertex(std::int64_t index, std::size_t vertices);

}  // namespace contactcheck::mesh
