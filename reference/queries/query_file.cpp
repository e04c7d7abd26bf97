#include "reference/queries/query_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::queries {
namespace {

/// A line longer than this is no line of numbers.
constexpr std::size_t kLongestLine = 1 << 16;

/// "vf", "326vf", "data_vf", but not "coffee" of "ee".
bool ends_with_word(const std::string& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  const std::size_t before = text.size() - end.size();
  return before == 0 || text[before - 1] < 'a' || text[before - 1] > 'z';
}

bool all_digits(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// numerator / denominator, if both are below 2^63, the numerator has at most 53 bits and the
/// denominator is a power of two: then the quotient is a double.
std::optional<double> plain_double(std::string_view numerator, std::string_view denominator) {
  const auto top = text::whole_number<std::int64_t>(numerator);
  const auto bottom = text::whole_number<std::int64_t>(denominator);
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  if (!top || !bottom || *top > kMost || *top < -kMost || *bottom <= 0) return std::nullopt;
  const auto divisor = static_cast<std::uint64_t>(*bottom);
  if (!std::has_single_bit(divisor)) return std::nullopt;
  return std::ldexp(static_cast<double>(*top), -std::countr_zero(divisor));
}

/// The double that equals the rational, if there is one.
std::optional<double> exact_double(const mpq_class& value) {
  const double rounded = value.get_d();  // towards zero
  if (!std::isfinite(rounded) || mpq_class(rounded) != value) return std::nullopt;
  return rounded;
}

}  // namespace

std::optional<ImpactKind> kind_of_file(const std::filesystem::path& file) {
  const std::string stem = text::lower_case(file.stem().string());
  if (ends_with_word(stem, "vf")) return ImpactKind::vertex_triangle;
  if (ends_with_word(stem, "ee")) return ImpactKind::edge_edge;
  std::optional<ImpactKind> kind;
  for (const auto& part : std::filesystem::absolute(file)) {
    const std::string name = text::lower_case(part.stem().string());
    if (name == "vertex-face") kind = ImpactKind::vertex_triangle;
    if (name == "edge-edge") kind = ImpactKind::edge_edge;
  }
  return kind;
}

QueryReader::QueryReader(std::filesystem::path file, ImpactKind kind)
    : file_(std::move(file)),
      in_(open_input_file(file_, "query file " + text::in_quotes(file_.string()))),
      kind_(kind),
      text_(kLongestLine + 1) {}

void QueryReader::fail(const std::string& what) const {
  throw InputError(file_.string() + ", line " + std::to_string(line_) + ": " + what);
}

bool QueryReader::next_line() {
  in_.getline(text_.data(), static_cast<std::streamsize>(text_.size()));
  const auto length = static_cast<std::size_t>(in_.gcount());
  if (in_.bad()) fail("reading failed");
  if (in_.eof() && length == 0) return false;
  ++line_;
  if (in_.fail()) fail("a line of more than 65536 bytes");
  // The count has the line's end, which a last line may lack.
  line_text_ = std::string_view(text_.data(), in_.eof() ? length : length - 1);
  return true;
}

bool QueryReader::next(FileQuery& query) {
  query.query.kind = kind_;
  query.in_doubles = true;
  query.truth.reset();
  std::array<std::array<std::pair<mpz_class, mpz_class>, 3>, 8> fractions;
  std::array<std::array<std::optional<double>, 3>, 8> values;
  for (std::size_t row = 0; row < 8; ++row) {
    bool read = next_line();
    while (read && row == 0 && trimmed(line_text_).empty()) read = next_line();
    if (!read) {
      if (row == 0 && columns_ == 0) throw InputError(file_.string() + ": the file is empty");
      if (row == 0) return false;
      fail("a query has eight lines; the last one has " + std::to_string(row));
    }
    if (row == 0) query.line = line_;
    std::array<std::string_view, 7> cells;
    std::size_t count = 0;
    for (std::string_view rest = line_text_;; ++count) {
      const std::size_t comma = rest.find(',');
      if (count == cells.size()) fail("more than seven columns");
      cells[count] = trimmed(rest.substr(0, comma));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    ++count;
    if (count < 6)
      fail(
          "six or seven columns are needed (numerator and denominator of x, y and z, and the "
          "truth), not " +
          std::to_string(count));
    if (columns_ == 0) columns_ = count;
    if (count != columns_)
      fail(std::to_string(count) + " columns, where the file began with " +
           std::to_string(columns_));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view numerator = cells[2 * axis], denominator = cells[2 * axis + 1];
      values[row][axis] = plain_double(numerator, denominator);
      if (values[row][axis]) continue;
      for (const std::string_view cell : {numerator, denominator})
        if (!all_digits(cell)) fail(text::in_quotes(std::string(cell), 40) + " is no whole number");
      auto& [top, bottom] = fractions[row][axis];
      top.set_str(std::string(numerator), 10);  // 0 would be octal
      bottom.set_str(std::string(denominator), 10);
      if (bottom == 0) fail("a denominator is zero");
      mpq_class value(top, bottom);
      value.canonicalize();
      values[row][axis] = exact_double(value);
      if (!values[row][axis]) {
        query.in_doubles = false;
        top = value.get_num();
        bottom = value.get_den();
      }
    }
    if (count == 7) {
      if (cells[6] != "0" && cells[6] != "1")
        fail("the truth is 0 or 1, not " + text::in_quotes(std::string(cells[6]), 40));
      const bool truth = cells[6] == "1";
      if (query.truth.value_or(truth) != truth) fail("the truth differs within a query");
      query.truth = truth;
    }
  }
  for (std::size_t point = 0; point < 4; ++point)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool end : {false, true}) {
        const std::size_t row = point + (end ? 4 : 0);
        const std::optional<double>& value = values[row][axis];
        if (query.in_doubles) {
          (end ? query.query.end : query.query.start)[point][static_cast<int>(axis)] = *value;
        } else {
          const auto& [top, bottom] = fractions[row][axis];
          (end ? query.rational.end : query.rational.start)[point][axis] =
              value ? mpq_class(*value) : mpq_class(top, bottom);
        }
      }
  query.rational.kind = kind_;
  return true;
}

std::vector<bool> read_truth(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) -> InputError {
    return InputError(file.string() + ": " + what);
  };
  const auto json = nlohmann::json::parse(text::read_file_bytes(file, "truth file"), nullptr,
                                          /*exceptions=*/false);
  if (!json.is_array()) throw fail("a JSON list of true and false is needed");
  std::vector<bool> truth;
  truth.reserve(json.size());
  for (const auto& value : json) {
    if (value.is_boolean())
      truth.push_back(value.get<bool>());
    else if (value.is_number_unsigned() && value.get<std::uint64_t>() <= 1)
      truth.push_back(value.get<std::uint64_t>() == 1);
    else
      throw fail("element " + std::to_string(truth.size()) + " is neither true nor false");
  }
  return truth;
}

}  // namespace contactcheck::queries
