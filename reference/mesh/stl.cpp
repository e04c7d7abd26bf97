#include <algorithm>
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

constexpr std::size_t kHeader = 84, kFacet = 50, kNormal = 12;  // bytes

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(text::whole_of_bytes(bytes.substr(at, 4), std::endian::little));
}

// `keyword` is in lower case.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(word, keyword, {}, [](char c) { return text::lower_case(c); });
}

// The count in a binary file's header, behind 80 bytes of any content. Text has no zero bytes.
std::size_t claimed_triangles(std::string_view bytes) { return little_endian(bytes, kHeader - 4); }

bool is_text(std::string_view bytes) {
  if (bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * claimed_triangles(bytes))
    return false;
  if (bytes.substr(0, kHeader).find('\0') != std::string_view::npos) return false;
  const std::string_view first = TextCursor(bytes).word();
  return is_keyword(first, "solid") || is_keyword(first, "facet");
}

PolygonSoup read_binary(std::string_view bytes, const std::string& name) {
  const auto refuse = [&](const std::string& what) { throw InputError(name + what + "."); };
  if (bytes.size() < kHeader)
    refuse(
        " is no STL: it begins neither with \"solid\" nor as a binary "
        "file does, whose header has 84 bytes");
  const std::size_t triangles = claimed_triangles(bytes), held = (bytes.size() - kHeader) / kFacet;
  if (held < triangles)
    refuse(" is no STL in text, and too short for a binary one: its header claims " +
           std::to_string(triangles) + " triangles, and it ends within triangle " +
           std::to_string(held));
  if (const std::size_t more = bytes.size() - kHeader - kFacet * triangles; more > 0)
    refuse(" has " + text::counted(more, "byte") + " more than its " + std::to_string(triangles) +
           " triangles");
  PolygonSoup out;
  out.points.reserve(3 * triangles);
  for (std::size_t corner = 0; corner < 3 * triangles; ++corner) {
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float value = std::bit_cast<float>(little_endian(
          bytes, kHeader + kFacet * (corner / 3) + kNormal + 4 * (3 * (corner % 3) + axis)));
      if (!std::isfinite(value))
        refuse(": corner " + std::to_string(corner % 3) + " of triangle " +
               std::to_string(corner / 3) + coordinate_fault(value));
      point[static_cast<Eigen::Index>(axis)] = value;
    }
    out.points.push_back(point);
  }
  return out;
}

class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& name) : cursor_(bytes), name_(name) {}

  PolygonSoup read() {
    for (std::string_view word; !(word = cursor_.word()).empty();) {
      if (is_keyword(word, "vertex")) {
        read_vertex();
      } else if (is_keyword(word, "facet")) {
        begin_facet();
      } else if (is_keyword(word, "normal")) {
        for (int axis = 0; axis < 3; ++axis) cursor_.word();  // it may be no number
      } else if (is_keyword(word, "endfacet")) {
        end_facet();
      } else if (is_keyword(word, "solid") || is_keyword(word, "endsolid")) {
        closed_ = is_keyword(word, "endsolid");
        cursor_.rest_of_line();  // a name, whatever its words
      } else if (!is_keyword(word, "outer") && !is_keyword(word, "loop") &&
                 !is_keyword(word, "endloop")) {
        refuse(": line " + std::to_string(cursor_.line()) + " has " + quoted_word(word) +
               ", which is no word of STL");
      }
    }
    if (in_facet_) refuse(" ends within triangle " + std::to_string(soup_.size()));
    if (!closed_) add_note(soup_.notes, "no \"endsolid\" at its end: it may be cut short");
    return std::move(soup_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + what + "."); }
  std::size_t corners_so_far() const {
    return soup_.points.size() - (soup_.ends.empty() ? 0 : soup_.ends.back());
  }

  void begin_facet() {
    if (in_facet_)
      refuse(": triangle " + std::to_string(soup_.size()) + " does not end before line " +
             std::to_string(cursor_.line()));
    in_facet_ = true;
    soup_.lines.push_back(static_cast<std::uint32_t>(cursor_.line()));
  }

  void read_vertex() {
    const std::size_t line = cursor_.line();
    const auto refuse_vertex = [&](const std::string& what) {
      refuse(": vertex " + std::to_string(soup_.points.size()) + " (line " + std::to_string(line) +
             ")" + what);
    };
    if (!in_facet_) refuse_vertex(" is in no facet");
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = cursor_.word();
      if (word.empty()) refuse(" ends within triangle " + std::to_string(soup_.size()));
      const std::optional<double> value = decimal<double>(word);
      if (!value) refuse_vertex(coordinate_fault(word));
      point[axis] = *value;
    }
    soup_.points.push_back(point);
  }

  void end_facet() {
    if (!in_facet_ || corners_so_far() != 3)
      refuse(": " + (in_facet_ ? "triangle " + std::to_string(soup_.size()) : "a facet") +
             " ends on line " + std::to_string(cursor_.line()) + " with " +
             std::to_string(corners_so_far()) + " vertices");
    in_facet_ = false;
    soup_.ends.push_back(soup_.points.size());
  }

  TextCursor cursor_;
  const std::string& name_;
  PolygonSoup soup_;
  bool in_facet_ = false, closed_ = false;
};

}  // namespace

PolygonSoup read_stl(std::string_view bytes, const std::string& name) {
  PolygonSoup out = is_text(bytes) ? TextReader(bytes, name).read() : read_binary(bytes, name);
  for (std::uint32_t corner = 0; corner < out.points.size(); ++corner)
    out.corners.push_back(corner);
  out.ends.clear();
  for (std::size_t end = 3; end <= out.corners.size(); end += 3) out.ends.push_back(end);
  return out;
}

}  // namespace contactcheck::mesh
