#include "reference/mesh/off_guard.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <vector>

#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::mesh {
namespace {

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

}  // namespace

std::optional<std::string> plain_off(const std::string& bytes, std::string& fault) {
  fault.clear();
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

}  // namespace contactcheck::mesh
