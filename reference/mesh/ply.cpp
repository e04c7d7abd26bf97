#include "reference/mesh/soup_guard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::mesh {
namespace {

// What CGAL's PLY reader may be given. That of CGAL 5.5.1 reads a length and allocates it, goes on
// with the next element after a list that it could not read, and casts by a property's name.

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct TypeNames {
  const char *name, *sized_name;
  Type type;
  std::size_t size;  // bytes in a binary file
};

constexpr TypeNames kTypes[] = {
    {"char", "int8", Type::kInt8, 1},      {"uchar", "uint8", Type::kUint8, 1},
    {"short", "int16", Type::kInt16, 2},   {"ushort", "uint16", Type::kUint16, 2},
    {"int", "int32", Type::kInt32, 4},     {"uint", "uint32", Type::kUint32, 4},
    {"float", "float32", Type::kFloat, 4}, {"double", "float64", Type::kDouble, 8}};

const TypeNames* type_of(const std::string& word) {
  for (const TypeNames& names : kTypes)
    if (word == names.name || word == names.sized_name) return &names;
  return nullptr;
}

struct Property {
  const TypeNames* length = nullptr;  // of a list
  const TypeNames* item = nullptr;
  std::string name;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

bool is_floating(const TypeNames& type) {
  return type.type == Type::kFloat || type.type == Type::kDouble;
}

bool add_element(const std::vector<std::string>& words, Header& header) {
  const auto count = words.size() > 2 ? text::whole_number<std::size_t>(words[2]) : std::nullopt;
  if (count) header.elements.push_back({words[1], *count, {}});
  return count.has_value();
}

bool add_property(const std::vector<std::string>& words, Header& header) {
  const bool list = words.size() > 4 && words[1] == "list";
  if (header.elements.empty() || words.size() < 3) return false;
  Property property;
  if (list) property.length = type_of(words[2]);
  property.item = type_of(words[list ? 3 : 1]);
  property.name = words[list ? 4 : 2];
  header.elements.back().properties.push_back(property);
  return property.item && (!list || (property.length && !is_floating(*property.length)));
}

std::string next_line(std::istream& in) {
  std::string line;
  std::getline(in, line);
  return line;
}

// Leaves `in` behind the line "end_header".
std::optional<Header> read_header(std::istream& in) {
  if (text::words_of(next_line(in)) != std::vector<std::string>{"ply"}) return std::nullopt;
  const std::vector<std::string> format = text::words_of(next_line(in));
  if (format.size() != 3 || format[0] != "format") return std::nullopt;
  Header header{format[1], {}};
  while (in) {
    const std::vector<std::string> words = text::words_of(next_line(in));
    const std::string keyword = words.empty() ? "" : words[0];
    if (keyword == "end_header") return header;
    const bool good = keyword == "element"    ? add_element(words, header)
                      : keyword == "property" ? add_property(words, header)
                                              : keyword == "comment" || keyword == "obj_info";
    if (!good) return std::nullopt;
  }
  return std::nullopt;
}

bool is_vertex(const Element& element) {
  return element.name == "vertex" || element.name == "vertices";
}

bool is_coordinate(const Element& element, const Property& property) {
  return is_vertex(element) &&
         (property.name == "x" || property.name == "y" || property.name == "z");
}

bool is_corners(const Element& element, const Property& property) {
  return (element.name == "face" || element.name == "faces") &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

// The reader casts what has these names to these types, unchecked in a build without assertions.
bool names_have_their_types(const Header& header) {
  for (const Element& element : header.elements)
    for (const Property& property : element.properties) {
      const Type item = property.item->type;
      if (is_coordinate(element, property) && (property.length || !is_floating(*property.item)))
        return false;
      if (is_corners(element, property) &&
          (!property.length || (item != Type::kInt32 && item != Type::kUint32)))
        return false;
    }
  return true;
}

// A file of flat things may leave z out, but then nobody knows where they are.
std::string missing_coordinate(const Header& header) {
  for (const Element& element : header.elements)
    for (const char* name : {"x", "y", "z"})
      if (is_vertex(element) &&
          std::none_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& property) { return property.name == name; }))
        return std::string(" has vertices without a property ") + name;
  return "";
}

std::string plain_header(const Header& header) {
  std::string out = "ply\nformat " + header.format + " 1.0\n";
  for (const Element& element : header.elements) {
    const bool known = element.name == "vertex" || element.name == "vertices" ||
                       element.name == "face" || element.name == "faces";
    out += "element " + (known ? element.name : "other") + ' ' + std::to_string(element.count);
    out += '\n';
    for (const Property& property : element.properties) {
      out += "property ";
      if (property.length) out += std::string("list ") + property.length->name + ' ';
      const bool wanted = is_coordinate(element, property) || is_corners(element, property);
      out += std::string(property.item->name) + ' ' + (wanted ? property.name : "other") + '\n';
    }
  }
  return out + "end_header\n";
}

template <typename Integer>
std::optional<std::int64_t> in_range(const std::string& word) {
  return text::whole_number<Integer>(word);
}

// Nothing unless all of the word is a number of the type: the reader would go on behind the part
// that is one, or go on without reading.
std::optional<std::int64_t> integer(const std::string& word, Type type) {
  switch (type) {
    case Type::kInt8:
      return in_range<std::int8_t>(word);
    case Type::kUint8:
      return in_range<std::uint8_t>(word);
    case Type::kInt16:
      return in_range<std::int16_t>(word);
    case Type::kUint16:
      return in_range<std::uint16_t>(word);
    case Type::kInt32:
      return in_range<std::int32_t>(word);
    case Type::kUint32:
      return in_range<std::uint32_t>(word);
    case Type::kFloat:
    case Type::kDouble:
      break;
  }
  return std::nullopt;
}

bool is_finite_decimal(const std::string& word, Type type) {
  if (word.find_first_not_of("+-.0123456789eE") != std::string::npos) return false;
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  const double largest =
      type == Type::kFloat ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  return end == word.c_str() + word.size() && std::abs(value) <= largest;
}

// Steps over the values of a file; false where one is missing or is none of its type.
class Values {
 public:
  Values(std::istream& in, const std::string& format)
      : in_(in), ascii_(format == "ascii"), big_(format == "binary_big_endian") {}

  // What stands behind the last property on the line of a text's element.
  std::string rest_of_line() {
    std::string rest;
    if (ascii_) std::getline(in_, rest);
    const std::size_t first = rest.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : rest.substr(first);
  }

  // What stands behind the last element: words of a text, or how many bytes; white space may.
  std::string beyond() {
    const std::string rest{std::istreambuf_iterator<char>(in_), {}};
    const std::size_t first = rest.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return "";
    if (!ascii_) return " has " + std::to_string(rest.size()) + " bytes more than its header says";
    const std::string line = rest.substr(first, rest.find_first_of("\r\n", first) - first);
    return " goes on after the last element of its header: " + text::in_quotes(line, 40);
  }

  bool skip(const Property& property) {
    if (!property.length) return skip_item(*property.item);
    const auto length =
        ascii_ ? next_integer(property.length->type) : next_binary(*property.length);
    if (!length) return false;
    for (std::int64_t i = 0; i < *length; ++i)
      if (!skip_item(*property.item)) return false;
    return *length >= 0;
  }

 private:
  std::optional<std::int64_t> next_integer(Type type) {
    return in_ >> word_ ? integer(word_, type) : std::nullopt;
  }
  // A negative length, here a huge one, is longer than any file.
  std::optional<std::int64_t> next_binary(const TypeNames& type) {
    std::array<char, 8> bytes{};
    if (!in_.read(bytes.data(), static_cast<std::streamsize>(type.size))) return std::nullopt;
    std::int64_t value = 0;
    for (std::size_t i = 0; i < type.size; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[big_ ? i : type.size - 1 - i]);
    return value;
  }
  bool skip_item(const TypeNames& type) {
    std::array<char, 8> bytes{};
    if (!ascii_) return !!in_.read(bytes.data(), static_cast<std::streamsize>(type.size));
    if (!is_floating(type)) return next_integer(type.type).has_value();
    return in_ >> word_ && is_finite_decimal(word_, type.type);
  }

  std::istream& in_;
  bool ascii_, big_;
  std::string word_;
};

// Steps over the elements of one kind. False where a value is missing or is none of its type, or,
// with a fault, where a line holds more.
bool holds_elements(const Element& element, Values& values, std::string& fault) {
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties)
      if (!values.skip(property)) return false;
    const std::string rest = values.rest_of_line();
    if (rest.empty()) continue;
    fault = ": " + element.name + " " + std::to_string(i) +
            " has more on its line than its properties: " + text::in_quotes(rest, 40);
    return false;
  }
  return true;
}

bool holds_its_values(const Header& header, std::istream& in, std::size_t size,
                      std::string& fault) {
  Values values(in, header.format);
  for (const Element& element : header.elements)
    if (element.count > size || !holds_elements(element, values, fault)) return false;
  fault = values.beyond();
  return fault.empty();
}

// The same values under a header of our own, in which only x, y, z and the vertex indices keep
// their names. Nothing when a value is missing or does not fit its type, a coordinate is not
// float or double, or vertex indices are not int or uint; and when x, y or z is missing or the
// file goes on after its values, which `fault` then says as guarded_bytes does. In text each
// element has a line of its own.
std::optional<std::string> plain_ply(const std::string& bytes, std::string& fault) {
  std::istringstream in(bytes, std::ios::in | std::ios::binary);
  const std::optional<Header> header = read_header(in);
  if (!header || !names_have_their_types(*header)) return std::nullopt;
  fault = missing_coordinate(*header);
  if (!fault.empty()) return std::nullopt;
  // Where the file ends with its header and no line end, tellg() has no answer.
  const std::size_t body = in.eof() ? bytes.size() : static_cast<std::size_t>(in.tellg());
  if (!holds_its_values(*header, in, bytes.size(), fault)) return std::nullopt;
  return plain_header(*header) + bytes.substr(body);
}

using Words = std::vector<std::string>;

// The words of the next line that has some before '#'; empty at the end.
Words next_words(std::istream& in) {
  Words words;
  for (std::string line; words.empty() && std::getline(in, line);)
    words = text::words_of(line.substr(0, line.find('#')));
  return words;
}

// "OFF" behind what says that a vertex line goes on after x, y, z.
bool is_plain_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
  return word == "OFF";
}

// Numbers of vertices and faces; the keyword may be missing.
std::optional<std::array<std::size_t, 2>> off_header(std::istream& in) {
  Words words = next_words(in);
  if (!words.empty() && is_plain_keyword(words[0])) words.erase(words.begin());
  if (words.empty()) words = next_words(in);
  if (words.size() < 2) return std::nullopt;
  const auto vertices = text::whole_number<std::size_t>(words[0]),
             faces = text::whole_number<std::size_t>(words[1]);
  if (!vertices || !faces) return std::nullopt;
  return std::array{*vertices, *faces};
}

void append_line(const Words& words, std::size_t count, std::string& out) {
  for (std::size_t i = 0; i < std::min(count, words.size()); ++i) out += words[i] + ' ';
  out += '\n';
}

// A face is as many whole numbers as its first word says, and that word.
std::optional<std::size_t> face_words(const Words& words) {
  const auto corners = text::whole_number<std::size_t>(words[0]);
  if (!corners || *corners >= words.size()) return std::nullopt;
  for (std::size_t i = 1; i <= *corners; ++i)
    if (!text::whole_number<std::size_t>(words[i])) return std::nullopt;
  return *corners + 1;
}

std::string index_fault(const Words& words, std::size_t count, std::size_t face,
                        std::size_t vertices) {
  for (std::size_t i = 1; i < count; ++i)
    if (text::whole_number<std::size_t>(words[i]).value_or(vertices) >= vertices)
      return ": face " + std::to_string(face) + " names the vertex " + words[i] +
             "; the file has " + std::to_string(vertices) + ", counted from 0";
  return "";
}

// What follows the last face; white space and comments may.
std::string lines_beyond(std::istream& in, std::size_t vertices, std::size_t faces) {
  const Words first = next_words(in);
  if (first.empty()) return "";
  std::size_t count = 1;
  while (!next_words(in).empty()) ++count;
  std::string line;
  for (const std::string& word : first) line += (line.empty() ? "" : " ") + word;
  return " has " + std::to_string(count) + (count == 1 ? " line" : " lines") +
         " more than its header's " + std::to_string(vertices) + " vertices and " +
         std::to_string(faces) + " faces: " + text::in_quotes(line, 40);
}

std::optional<std::string> plain_off(const std::string& bytes, std::string& fault) {
  std::istringstream in(bytes);
  const auto header = off_header(in);
  if (!header) return std::nullopt;
  const auto [vertices, faces] = *header;
  if (std::max(vertices, faces) > bytes.size()) return std::nullopt;
  std::string out = "OFF\n" + std::to_string(vertices) + ' ' + std::to_string(faces) + " 0\n";
  for (std::size_t line = 0; line < vertices + faces; ++line) {
    const Words words = next_words(in);
    if (words.empty()) return out;  // the reader finds that the end is missing
    const std::optional<std::size_t> count = line < vertices ? 3 : face_words(words);
    if (!count) return std::nullopt;
    if (line >= vertices) fault = index_fault(words, *count, line - vertices, vertices);
    if (!fault.empty()) return std::nullopt;
    append_line(words, *count, out);
  }
  fault = lines_beyond(in, vertices, faces);
  if (!fault.empty()) return std::nullopt;
  return out;
}

}  // namespace

std::optional<std::string> guarded_bytes(SoupFormat format, const std::string& bytes,
                                         std::string& fault) {
  fault.clear();
  if (format == SoupFormat::kOff) return plain_off(bytes, fault);
  if (format == SoupFormat::kPly) return plain_ply(bytes, fault);
  return bytes;
}

}  // namespace contactcheck::mesh
