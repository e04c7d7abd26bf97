#include "reference/mesh/ply.h"

#include <algorithm>
#include <array>
#include <bit>
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
  if (format.size() != 3 || format[0] != "format" ||
      (format[1] != "ascii" && format[1] != "binary_little_endian" &&
       format[1] != "binary_big_endian"))
    return std::nullopt;
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

bool is_face(const Element& element) { return element.name == "face" || element.name == "faces"; }

bool is_corners(const Element& element, const Property& property) {
  return is_face(element) && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// Coordinates are floating, corners are lists of 32 bits.
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

// A file of flat things may leave z out, but then their position is unknown.
std::string missing_coordinate(const Header& header) {
  for (const Element& element : header.elements)
    for (const char* name : {"x", "y", "z"})
      if (is_vertex(element) &&
          std::none_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& property) { return property.name == name; }))
        return std::string(" has vertices without a property ") + name;
  return "";
}

// Where a second list of vertices begins, indices could go on or begin at 0 again.
std::string repeated_element(const Header& header) {
  if (std::ranges::count_if(header.elements, is_vertex) > 1)
    return " has more than one element of vertices";
  if (std::ranges::count_if(header.elements, is_face) > 1)
    return " has more than one element of faces";
  return "";
}

// Nothing unless all of the word is a number of the type.
std::optional<double> integer(const std::string& word, Type type) {
  switch (type) {
    case Type::kInt8:
      return text::whole_number<std::int8_t>(word);
    case Type::kUint8:
      return text::whole_number<std::uint8_t>(word);
    case Type::kInt16:
      return text::whole_number<std::int16_t>(word);
    case Type::kUint16:
      return text::whole_number<std::uint16_t>(word);
    case Type::kInt32:
      return text::whole_number<std::int32_t>(word);
    case Type::kUint32:
      return text::whole_number<std::uint32_t>(word);
    case Type::kFloat:
    case Type::kDouble:
      break;
  }
  return std::nullopt;
}

// The double that a word of a text gives, or the float where the property says float.
std::optional<double> finite_decimal(const std::string& word, Type type) {
  if (word.find_first_not_of("+-.0123456789eE") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  const double largest =
      type == Type::kFloat ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  if (end != word.c_str() + word.size() || std::abs(value) > largest) return std::nullopt;
  return type == Type::kFloat ? std::strtof(word.c_str(), nullptr) : value;
}

double number_of(std::uint64_t bits, Type type) {
  switch (type) {
    case Type::kInt8:
      return static_cast<std::int8_t>(bits);
    case Type::kInt16:
      return static_cast<std::int16_t>(bits);
    case Type::kInt32:
      return static_cast<std::int32_t>(bits);
    case Type::kUint8:
    case Type::kUint16:
    case Type::kUint32:
      return static_cast<double>(bits);
    case Type::kFloat:
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case Type::kDouble:
      return std::bit_cast<double>(bits);
  }
  return 0.0;
}

// The values of a file, one after the other.
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

  // False where one is missing or not of its type.
  bool read(const Property& property, std::vector<double>& out) {
    out.clear();
    double items = 1.0;
    if (property.length && (!read_item(*property.length, items) || items < 0.0)) return false;
    for (double value = 0.0; items > 0.0; --items) {
      if (!read_item(*property.item, value)) return false;
      out.push_back(value);
    }
    return true;
  }

 private:
  bool read_item(const TypeNames& type, double& out) {
    if (ascii_) {
      if (!(in_ >> word_)) return false;
      const std::optional<double> value =
          is_floating(type) ? finite_decimal(word_, type.type) : integer(word_, type.type);
      out = value.value_or(0.0);
      return value.has_value();
    }
    std::array<char, 8> bytes{};
    if (!in_.read(bytes.data(), static_cast<std::streamsize>(type.size))) return false;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.size; ++i)
      bits = bits << 8 | static_cast<unsigned char>(bytes[big_ ? i : type.size - 1 - i]);
    out = number_of(bits, type.type);
    return true;
  }

  std::istream& in_;
  bool ascii_, big_;
  std::string word_;
};

// An index below 0 names no vertex, as the largest does.
std::uint32_t corner_of(double index) {
  return index < 0.0 ? std::numeric_limits<std::uint32_t>::max()
                     : static_cast<std::uint32_t>(index);
}

// False where a value is missing or not of its type, or, with a fault, where a line holds more.
bool read_elements(const Element& element, Values& values, PolygonSoup& soup, std::string& fault) {
  const std::vector<Property>& properties = element.properties;
  const auto first = [&](const char* name) {
    const auto named = [&](const Property& property) { return property.name == name; };
    return static_cast<std::size_t>(std::ranges::find_if(properties, named) - properties.begin());
  };
  const bool vertex = is_vertex(element), face = is_face(element);
  const std::size_t x = first("x"), y = first("y"), z = first("z"),
                    indices = first("vertex_indices");
  const std::size_t corners = indices < properties.size() ? indices : first("vertex_index");
  if (face && corners == properties.size()) return false;
  std::vector<double> read;
  for (std::size_t i = 0; i < element.count; ++i) {
    Vec3 point = Vec3::Zero();
    for (std::size_t p = 0; p < properties.size(); ++p) {
      if (!values.read(properties[p], read)) return false;
      if (vertex && (p == x || p == y || p == z)) point[p == x ? 0 : p == y ? 1 : 2] = read[0];
      if (face && p == corners)
        std::ranges::transform(read, std::back_inserter(soup.polygons.emplace_back()), corner_of);
    }
    if (vertex) soup.points.push_back(point);
    const std::string rest = values.rest_of_line();
    if (rest.empty()) continue;
    const std::string name = vertex || face ? element.name : text::in_quotes(element.name, 40);
    fault = ": " + name + " " + std::to_string(i) +
            " has more on its line than its properties: " + text::in_quotes(rest, 40);
    return false;
  }
  return true;
}

}  // namespace

bool read_ply(const std::string& bytes, PolygonSoup& out, std::string& fault) {
  out = {};
  std::istringstream in(bytes, std::ios::in | std::ios::binary);
  const std::optional<Header> header = read_header(in);
  if (!header || !names_have_their_types(*header)) return false;
  fault = missing_coordinate(*header);
  if (fault.empty()) fault = repeated_element(*header);
  if (!fault.empty()) return false;
  Values values(in, header->format);
  for (const Element& element : header->elements)
    if (element.count > bytes.size() || !read_elements(element, values, out, fault)) return false;
  fault = values.beyond();
  return fault.empty();
}

}  // namespace contactcheck::mesh
