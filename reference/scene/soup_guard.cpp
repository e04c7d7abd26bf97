#include "reference/scene/soup_guard.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string_view>
#include <vector>

namespace contactcheck {
namespace {

std::optional<std::size_t> whole_number(std::string_view word) {
  std::size_t value = 0;
  const char* end = word.data() + word.size();
  const std::from_chars_result read = std::from_chars(word.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

using Words = std::vector<std::string>;

// The words of the next line that has some; empty at the end. `comments`: '#' starts one.
Words next_words(std::istream& in, bool comments) {
  Words words;
  for (std::string line; words.empty() && std::getline(in, line);) {
    std::istringstream text(comments ? line.substr(0, line.find('#')) : line);
    for (std::string word; text >> word;) words.push_back(word);
  }
  return words;
}

// --- OFF ---

// "OFF" behind what says that a vertex line goes on after x, y, z.
bool is_plain_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
  return word == "OFF";
}

// Numbers of vertices and faces; the keyword may be missing.
std::optional<std::array<std::size_t, 2>> off_header(std::istream& in) {
  Words words = next_words(in, true);
  if (!words.empty() && is_plain_keyword(words[0])) words.erase(words.begin());
  if (words.empty()) words = next_words(in, true);
  if (words.size() < 2) return std::nullopt;
  const auto vertices = whole_number(words[0]), faces = whole_number(words[1]);
  if (!vertices || !faces) return std::nullopt;
  return std::array{*vertices, *faces};
}

void append_line(const Words& words, std::size_t count, std::string& out) {
  for (std::size_t i = 0; i < std::min(count, words.size()); ++i) out += words[i] + ' ';
  out += '\n';
}

// A face is as many whole numbers as its first word says, and that word.
std::optional<std::size_t> face_words(const Words& words) {
  const auto corners = whole_number(words[0]);
  if (!corners || *corners >= words.size()) return std::nullopt;
  for (std::size_t i = 1; i <= *corners; ++i)
    if (!whole_number(words[i])) return std::nullopt;
  return *corners + 1;
}

std::optional<std::string> plain_off(const std::string& bytes) {
  std::istringstream in(bytes);
  const auto header = off_header(in);
  if (!header) return std::nullopt;
  const auto [vertices, faces] = *header;
  if (std::max(vertices, faces) > bytes.size()) return std::nullopt;
  std::string out = "OFF\n" + std::to_string(vertices) + ' ' + std::to_string(faces) + " 0\n";
  for (std::size_t line = 0; line < vertices + faces; ++line) {
    const Words words = next_words(in, true);
    if (words.empty()) return out;  // the reader finds that the end is missing
    const std::optional<std::size_t> count = line < vertices ? 3 : face_words(words);
    if (!count) return std::nullopt;
    append_line(words, *count, out);
  }
  return out;
}

// --- PLY ---

struct PlyProperty {
  bool list = false;
  std::size_t length_size = 0, item_size = 0;  // bytes in a binary file
};

struct PlyElement {
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
};

// Zero: no type of PLY.
std::size_t size_of_type(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "double" || type == "float64") return 8;
  const bool four = type == "int" || type == "uint" || type == "float" || type == "int32" ||
                    type == "uint32" || type == "float32";
  return four ? 4 : 0;
}

bool add_property(const Words& words, PlyHeader& header) {
  if (header.elements.empty() || words.size() < 3) return false;
  PlyProperty property;
  property.list = words[1] == "list";
  if (property.list && words.size() < 5) return false;
  if (property.list) property.length_size = size_of_type(words[2]);
  property.item_size = size_of_type(words[property.list ? 3 : 1]);
  header.elements.back().properties.push_back(property);
  return property.item_size > 0 && (!property.list || property.length_size > 0);
}

// Leaves `in` behind the line "end_header".
std::optional<PlyHeader> ply_header(std::istream& in) {
  PlyHeader header;
  for (;;) {
    const Words words = next_words(in, false);
    if (words.empty()) return std::nullopt;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() > 1) header.format = words[1];
    if (words[0] == "element") {
      const auto count = words.size() > 2 ? whole_number(words[2]) : std::nullopt;
      if (!count) return std::nullopt;
      header.elements.push_back({*count, {}});
    }
    if (words[0] == "property" && !add_property(words, header)) return std::nullopt;
  }
}

// Steps over the values of a file; false at its end, or where a list says that it is longer.
class PlyWalk {
 public:
  PlyWalk(std::istream& in, const std::string& format)
      : in_(in), ascii_(format == "ascii"), big_(format == "binary_big_endian") {}

  bool skip(const PlyProperty& property) {
    if (!property.list) return skip_items(1, property.item_size);
    const auto length = ascii_ ? next_whole() : next_binary(property.length_size);
    return length && skip_items(*length, property.item_size);
  }

 private:
  std::optional<std::size_t> next_whole() {
    std::string word;
    if (!(in_ >> word)) return std::nullopt;
    return whole_number(word);
  }
  std::optional<std::size_t> next_binary(std::size_t size) {
    std::array<char, 8> bytes{};
    if (!in_.read(bytes.data(), static_cast<std::streamsize>(size))) return std::nullopt;
    std::size_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[big_ ? i : size - 1 - i]);
    return value;
  }
  bool skip_items(std::size_t count, std::size_t size) {
    std::string word;
    std::array<char, 8> bytes{};
    for (std::size_t i = 0; i < count; ++i) {
      if (ascii_ && !(in_ >> word)) return false;
      if (!ascii_ && !in_.read(bytes.data(), static_cast<std::streamsize>(size))) return false;
    }
    return true;
  }

  std::istream& in_;
  bool ascii_, big_;
};

bool ply_holds_its_lists(const std::string& bytes) {
  std::istringstream in(bytes, std::ios::in | std::ios::binary);
  const std::optional<PlyHeader> header = ply_header(in);
  if (!header) return false;
  PlyWalk walk(in, header->format);
  for (const PlyElement& element : header->elements) {
    if (element.count > bytes.size()) return false;
    for (std::size_t i = 0; i < element.count; ++i)
      for (const PlyProperty& property : element.properties)
        if (!walk.skip(property)) return false;
  }
  return true;
}

}  // namespace

std::optional<std::string> guarded_bytes(SoupFormat format, const std::string& bytes) {
  if (format == SoupFormat::kOff) return plain_off(bytes);
  if (format == SoupFormat::kPly && !ply_holds_its_lists(bytes)) return std::nullopt;
  return bytes;
}

}  // namespace contactcheck
