#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "reference/mesh/polygon_soup.h"
#include "reference/mesh/text_cursor.h"
#include "reference/text/counted.h"
#include "reference/text/words.h"

namespace contactcheck::mesh {
namespace {

/// What a file has besides x, y, z, by the letters before "OFF".
struct Prefixes {
  bool texture = false, colour = false, normal = false, homogeneous = false, dimension = false;
};

/// A keyword with what is glued to it: "CSTOFF", "OFF4".
struct Keyword {
  Prefixes prefixes;
  std::string_view rest;
};

std::optional<Keyword> keyword_of(std::string_view word) {
  Keyword out;
  const std::array<std::pair<std::string_view, bool*>, 5> known = {
      std::pair{"ST", &out.prefixes.texture},
      {"C", &out.prefixes.colour},
      {"N", &out.prefixes.normal},
      {"4", &out.prefixes.homogeneous},
      {"n", &out.prefixes.dimension}};
  while (!word.starts_with("OFF")) {
    const auto at = std::ranges::find_if(known, [&](const auto& prefix) {
      return word.starts_with(prefix.first) && !*prefix.second;
    });
    if (at == known.end()) return std::nullopt;
    *at->second = true;
    word.remove_prefix(at->first.size());
  }
  out.rest = word.substr(3);
  return out;
}

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), cursor_(bytes, TextCursor::Rule::kHashComments), name_(name) {}

  PolygonSoup read() {
    const std::optional<Keyword> keyword = read_keyword();
    if (keyword) prefixes_ = keyword->prefixes;
    TextCursor behind_keyword = cursor_;
    if (keyword && keyword->rest.empty() && behind_keyword.word_of_line() == "BINARY") {
      at_ = behind_keyword.offset();
      read_binary();
    } else {
      read_text(keyword ? keyword->rest : std::string_view());
    }
    return std::move(soup_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + what + "."); }
  // In text with the line.
  [[noreturn]] void refuse_vertex(std::size_t line, const std::string& what) const {
    refuse(": vertex " + std::to_string(soup_.points.size()) +
           (line > 0 ? " (line " + std::to_string(line) + ")" : "") + what);
  }
  [[noreturn]] void refuse_face(const std::string& what) const {
    refuse(": " + soup_.place_of(soup_.size()) + " " + what);
  }
  [[noreturn]] void refuse_end() const {
    const bool in_vertices = soup_.points.size() < vertices_;
    refuse(std::string(" ends within ") + (in_vertices ? "vertex " : "face ") +
           std::to_string(in_vertices ? soup_.points.size() : soup_.size()) + " of " +
           std::to_string(in_vertices ? vertices_ : faces_));
  }

  // Leaves the cursor behind it; at the beginning where there is none.
  std::optional<Keyword> read_keyword() {
    const TextCursor begin = cursor_;
    const std::string_view word = cursor_.word();
    std::optional<Keyword> out = keyword_of(word);
    if (!out) {
      if (!text::whole_number<std::size_t>(word))
        refuse(" is no OFF: it begins with " + quoted_word(word));
      cursor_ = begin;
    }
    return out;
  }

  void take_counts(std::int64_t vertices, std::int64_t faces) {
    // A vertex or face takes at least two bytes: a larger number would only exhaust the memory.
    const auto most = static_cast<std::int64_t>(bytes_.size());
    if (vertices < 0 || faces < 0 || vertices > most || faces > most)
      refuse(" claims " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
             " faces, more than its " + std::to_string(bytes_.size()) + " bytes can hold");
    vertices_ = static_cast<std::size_t>(vertices);
    faces_ = static_cast<std::size_t>(faces);
    soup_.points.reserve(vertices_);
    soup_.ends.reserve(faces_);
  }

  void take_dimension(std::int64_t dimension) const {
    if (dimension != 3)
      refuse(" has vertices of " + std::to_string(dimension) +
             " dimensions; only those of 3 can be read");
  }

  // A homogeneous point is divided by its weight.
  void take_point(std::size_t line, const std::array<double, 4>& values) {
    Vec3 point(values[0], values[1], values[2]);
    if (prefixes_.homogeneous && values[3] != 1.0) {
      point /= values[3];
      if (!point.allFinite())
        refuse_vertex(line,
                      " lies at infinity: its fourth coordinate is " + std::to_string(values[3]));
    }
    soup_.points.push_back(point);
  }
  std::size_t values_of_point() const { return prefixes_.homogeneous ? 4 : 3; }

  std::int64_t whole_word(std::string_view word, const char* what) const {
    const auto value = text::whole_number<std::int64_t>(word);
    if (!value)
      refuse(" has " + quoted_word(word) + " on line " + std::to_string(cursor_.line()) +
             ", where " + what + " should be");
    return *value;
  }

  // `glued`: what stands at the keyword without a blank.
  void read_text(std::string_view glued) {
    const auto next = [&] { return glued.empty() ? cursor_.word() : std::exchange(glued, {}); };
    if (prefixes_.dimension) take_dimension(whole_word(next(), "the number of dimensions"));
    const std::int64_t vertices = whole_word(next(), "the number of vertices");
    const std::size_t line = cursor_.line();
    const std::int64_t faces = whole_word(cursor_.word(), "the number of faces");
    // The number of edges is left out by many, if they have all numbers on one line.
    const std::string_view edges = cursor_.line() == line ? cursor_.word_of_line() : cursor_.word();
    if (!edges.empty()) whole_word(edges, "the number of edges");
    take_counts(vertices, faces);
    read_text_elements();
  }

  // Geomview's grammar knows no lines but those that end a face's colour, and people end vertices
  // by lines, too, with a colour or without. So whatever is left of the line of an element's last
  // word is left out, unless there are too few lines: then several elements stand on one.
  void read_text_elements() {
    const bool more_values = prefixes_.texture || prefixes_.colour || prefixes_.normal;
    const bool by_lines = more_values || has_lines_for_elements();
    while (soup_.points.size() < vertices_) {
      read_text_vertex();
      if (by_lines) leave_out_values();
    }
    while (soup_.size() < faces_) {
      read_text_face();
      if (by_lines) cursor_.rest_of_line();
    }
    refuse_more();
  }

  bool has_lines_for_elements() const {
    TextCursor lines = cursor_;
    std::size_t left = vertices_ + faces_;
    while (left > 0 && lines.next_line())
      if (!lines.word_of_line().empty()) --left;
    return left == 0;
  }

  void read_text_vertex() {
    std::array<double, 4> values{};
    std::size_t line = 0;
    for (std::size_t i = 0; i < values_of_point(); ++i) {
      const std::string_view word = cursor_.word();
      if (word.empty()) refuse_end();
      if (i == 0) line = cursor_.line();
      const std::optional<double> value = decimal<double>(word);
      if (!value) refuse_vertex(cursor_.line(), coordinate_fault(word));
      values[i] = *value;
    }
    take_point(line, values);
  }

  void leave_out_values() {
    for (std::string_view word; !(word = cursor_.word_of_line()).empty();)
      if (!looks_like_a_number(word))
        refuse(": vertex " + std::to_string(soup_.points.size() - 1) + " (line " +
               std::to_string(cursor_.line()) + ") has " + quoted_word(word) +
               " behind its coordinates");
  }

  void read_text_face() {
    std::string_view word = cursor_.word();
    if (word.empty()) refuse_end();
    soup_.lines.push_back(static_cast<std::uint32_t>(cursor_.line()));
    const auto corners = text::whole_number<std::size_t>(word);
    if (!corners)
      refuse_face("begins with " + quoted_word(word) + ", which is no number of corners");
    for (std::size_t i = 0; i < *corners; ++i) {
      word = cursor_.word();
      if (word.empty()) refuse_end();
      const auto index = text::whole_number<std::int64_t>(word);
      if (!index)
        refuse_face("has the vertex index " + quoted_word(word) + ", which is no whole number");
      take_corner(*index);
    }
    soup_.ends.push_back(soup_.corners.size());
  }

  void take_corner(std::int64_t index) {
    if (index < 0 || static_cast<std::size_t>(index) >= vertices_)
      refuse_face(names_no_vertex(index, vertices_));
    soup_.corners.push_back(static_cast<std::uint32_t>(index));
  }

  // White space and comments may follow.
  void refuse_more() {
    std::string line;
    std::size_t count = 0;
    do {
      const std::string_view rest = cursor_.rest_of_line();
      if (!rest.empty() && count++ == 0) line = rest;
    } while (cursor_.next_line());
    if (count > 0)
      refuse(" has " + text::counted(count, "line") + " more than its header's " +
             std::to_string(vertices_) + " vertices and " + std::to_string(faces_) +
             " faces: " + quoted_word(line));
  }

  // Words of 32 bits, the highest byte first.
  std::uint32_t next_bits() {
    if (bytes_.size() - at_ < 4) refuse_end();
    at_ += 4;
    return static_cast<std::uint32_t>(
        text::whole_of_bytes(bytes_.substr(at_ - 4, 4), std::endian::big));
  }
  std::int32_t next_whole() { return static_cast<std::int32_t>(next_bits()); }

  void read_binary() {
    if (at_ < bytes_.size() && bytes_[at_] == '\r') ++at_;
    if (at_ >= bytes_.size() || bytes_[at_] != '\n')
      refuse(" has no end of line behind \"BINARY\"");
    ++at_;
    if (prefixes_.dimension) take_dimension(next_whole());
    const std::int32_t vertices = next_whole(), faces = next_whole();
    next_whole();  // edges
    take_counts(vertices, faces);
    const std::size_t more =
        (prefixes_.normal ? 3 : 0) + (prefixes_.colour ? 4 : 0) + (prefixes_.texture ? 2 : 0);
    while (soup_.points.size() < vertices_) {
      std::array<double, 4> values{};
      for (std::size_t i = 0; i < values_of_point(); ++i) {
        const float value = std::bit_cast<float>(next_bits());
        if (!std::isfinite(value)) refuse_vertex(0, coordinate_fault(value));
        values[i] = value;
      }
      take_point(0, values);
      for (std::size_t i = 0; i < more; ++i) next_bits();
    }
    while (soup_.size() < faces_) {
      for (std::int32_t left = next_whole(); left > 0; --left) take_corner(next_whole());
      soup_.ends.push_back(soup_.corners.size());
      for (std::int32_t left = next_whole(); left > 0; --left) next_bits();
    }
    if (at_ < bytes_.size())
      refuse(" has " + std::to_string(bytes_.size() - at_) + " bytes more than its header says");
  }

  std::string_view bytes_;
  TextCursor cursor_;
  const std::string& name_;
  Prefixes prefixes_;
  std::size_t vertices_ = 0, faces_ = 0;
  std::size_t at_ = 0;  // in a binary file
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_off(std::string_view bytes, const std::string& name) {
  return OffReader(bytes, name).read();
}

}  // namespace contactcheck::mesh
