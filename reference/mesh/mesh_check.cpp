#include "reference/mesh/mesh_check.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <sstream>
#include <string_view>
#include <vector>

#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::mesh {
namespace {

constexpr std::size_t kStlHeader = 84, kStlFacet = 50, kStlNormal = 12;

struct Line {
  std::size_t number;  // counted from 1
  std::vector<std::string> words;
};

// Calls `visit(Line)` for every line with words, until it returns false.
void for_lines(const std::string& bytes, const std::function<bool(const Line&)>& visit) {
  std::istringstream in(bytes);
  std::string text;
  for (std::size_t number = 1; std::getline(in, text); ++number) {
    std::istringstream words(text.substr(0, text.find('#')));
    Line line{number, {}};
    for (std::string word; words >> word;) line.words.push_back(word);
    if (!line.words.empty() && !visit(line)) return;
  }
}

bool finite_number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0' && std::isfinite(value);
}

// The fault of the three coordinates at words[first..first+2]; empty for good ones.
std::string vertex_fault(std::size_t vertex, const Line& line, std::size_t first) {
  const std::string place =
      "vertex " + std::to_string(vertex) + " (line " + std::to_string(line.number) + ") has ";
  if (line.words.size() < first + 3) return place + "fewer than three coordinates";
  for (std::size_t k = first; k < first + 3; ++k) {
    if (finite_number(line.words[k])) continue;
    return place + "the coordinate " + text::in_quotes(line.words[k], 40) +
           "; coordinates must be finite numbers";
  }
  return "";
}

std::string keyword_vertex_fault(const std::string& keyword, const std::string& bytes) {
  std::string fault;
  std::size_t vertex = 0;
  for_lines(bytes, [&](const Line& line) {
    if (line.words[0] == keyword) fault = vertex_fault(vertex++, line, 1);
    return fault.empty();
  });
  return fault;
}

// What is wrong with the vertex of a corner, "7" or "7/1/3"; empty when nothing is. A negative
// index counts back from the last vertex so far.
std::string corner_fault(const std::string& word, std::size_t so_far, std::size_t in_all) {
  std::string_view index = std::string_view(word).substr(0, word.find('/'));
  if (index.size() > 1 && index[0] == '+' && index[1] != '-') index.remove_prefix(1);
  const auto value = text::whole_number<std::int64_t>(index);
  if (!value)
    return "has the vertex index " + text::in_quotes(word, 40) + ", which is no whole number";
  const auto bound = static_cast<std::int64_t>(*value < 0 ? so_far : in_all);
  if (*value != 0 && -bound <= *value && *value <= bound) return "";
  const std::string place = "names the vertex " + std::to_string(*value) + "; ";
  if (*value == 0) return place + "they count from 1";
  return place + "the file has " + std::to_string(bound) + (*value < 0 ? " before that line" : "");
}

bool is_off_keyword(const std::string& word) {
  return word.size() >= 3 && word.compare(word.size() - 3, 3, "OFF") == 0;
}

// The vertex lines of OFF follow the line of counts, those of PLY the line "end_header".
std::string listed_vertex_fault(SoupFormat format, const std::string& bytes) {
  const std::optional<SoupCounts> counts = claimed_counts(format, bytes);
  if (!counts) return "";
  std::string fault;
  bool header = true;
  std::size_t vertex = 0;
  for_lines(bytes, [&](const Line& line) {
    if (header) {
      const std::string& last = line.words.back();
      header = format == SoupFormat::kPly ? last != "end_header" : is_off_keyword(last);
      return true;
    }
    if (vertex == counts->vertices) return false;
    fault = vertex_fault(vertex++, line, 0);
    return fault.empty();
  });
  return fault;
}

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return value;
}

bool is_binary_stl(const std::string& bytes) {
  return bytes.size() >= kStlHeader &&
         bytes.size() == kStlHeader + kStlFacet * std::size_t{little_endian(bytes, 80)};
}

std::string binary_stl_fault(const std::string& bytes) {
  for (std::size_t facet = 0; facet < little_endian(bytes, 80); ++facet) {
    for (std::size_t k = 0; k < 9; ++k) {
      const std::size_t at = kStlHeader + kStlFacet * facet + kStlNormal + 4 * k;
      const auto value = std::bit_cast<float>(little_endian(bytes, at));
      if (std::isfinite(value)) continue;
      return "corner " + std::to_string(k / 3) + " of triangle " + std::to_string(facet) +
             " has the coordinate " + (std::isnan(value) ? "nan" : "inf") +
             "; coordinates must be finite numbers";
    }
  }
  return "";
}

std::optional<SoupCounts> off_counts(const std::string& bytes) {
  std::vector<std::string> words;
  for_lines(bytes, [&](const Line& line) {
    words.insert(words.end(), line.words.begin(), line.words.end());
    return words.size() < 3;
  });
  if (words.size() < 3 || !is_off_keyword(words[0])) return std::nullopt;
  const auto vertices = text::whole_number<std::size_t>(words[1]),
             faces = text::whole_number<std::size_t>(words[2]);
  if (!vertices || !faces) return std::nullopt;
  return SoupCounts{*vertices, *faces};
}

std::optional<SoupCounts> ply_counts(const std::string& bytes) {
  SoupCounts counts;
  bool ascii = false;
  for_lines(bytes, [&](const Line& line) {
    if (line.words[0] == "format" && line.words.size() > 1) ascii = line.words[1] == "ascii";
    if (line.words[0] == "element" && line.words.size() > 2) {
      const std::size_t number = text::whole_number<std::size_t>(line.words[2]).value_or(0);
      if (line.words[1] == "vertex" || line.words[1] == "vertices") counts.vertices = number;
      if (line.words[1] == "face" || line.words[1] == "faces") counts.faces = number;
    }
    return line.words[0] != "end_header";
  });
  if (!ascii) return std::nullopt;
  return counts;
}

}  // namespace

std::string coordinate_fault(SoupFormat format, const std::string& bytes) {
  switch (format) {
    case SoupFormat::kObj:
      return keyword_vertex_fault("v", bytes);
    case SoupFormat::kStl:
      return is_binary_stl(bytes) ? binary_stl_fault(bytes) : keyword_vertex_fault("vertex", bytes);
    case SoupFormat::kOff:
    case SoupFormat::kPly:
      return listed_vertex_fault(format, bytes);
  }
  return "";
}

std::string bytes_beyond_stl(const std::string& bytes) {
  if (bytes.size() < kStlHeader) return "";
  // The header of a binary file may begin with "solid", too, but no text has a zero byte.
  const std::string head = bytes.substr(0, kStlHeader);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (head.find('\0') == std::string::npos && head.find("solid") == first) return "";
  const std::size_t triangles = little_endian(bytes, 80);
  if (bytes.size() <= kStlHeader + kStlFacet * triangles) return "";
  return " has " + std::to_string(bytes.size() - kStlHeader - kStlFacet * triangles) +
         " bytes more than its " + std::to_string(triangles) + " triangles";
}

std::optional<SoupCounts> claimed_counts(SoupFormat format, const std::string& bytes) {
  if (format == SoupFormat::kOff) return off_counts(bytes);
  if (format == SoupFormat::kPly) return ply_counts(bytes);
  return std::nullopt;
}

std::string face_index_fault(SoupFormat format, const std::string& bytes) {
  if (format != SoupFormat::kObj) return "";
  std::size_t in_all = 0, so_far = 0, face = 0;
  for_lines(bytes, [&](const Line& line) { return in_all += line.words[0] == "v", true; });
  std::string fault;
  for_lines(bytes, [&](const Line& line) {
    so_far += line.words[0] == "v" ? 1 : 0;
    if (line.words[0] != "f") return true;
    for (std::size_t k = 1; k < line.words.size() && fault.empty(); ++k)
      fault = corner_fault(line.words[k], so_far, in_all);
    if (!fault.empty())
      fault =
          "face " + std::to_string(face) + " (line " + std::to_string(line.number) + ") " + fault;
    ++face;
    return fault.empty();
  });
  return fault;
}

std::size_t face_line_fault(SoupFormat format, const std::string& bytes, const PolygonSoup& soup) {
  if (format != SoupFormat::kObj) return 0;
  std::size_t face = 0, fault = 0;
  for_lines(bytes, [&](const Line& line) {
    if (line.words[0] != "f") return true;
    const std::size_t corners = line.words.size() - 1;
    if (face >= soup.polygons.size() || soup.polygons[face++].size() != corners) {
      fault = line.number;
    }
    return fault == 0;
  });
  return fault;
}

}  // namespace contactcheck::mesh
