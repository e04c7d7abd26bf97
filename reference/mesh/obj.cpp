#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "reference/mesh/polygon_soup.h"
#include "reference/mesh/text_cursor.h"
#include "reference/text/words.h"

namespace contactcheck::mesh {
namespace {

// What describes no surface, or only its looks.
constexpr std::array<std::string_view, 19> kNoSurface = {
    "vn",    "vt",       "vp",       "g",          "o",        "s",   "l",
    "p",     "mtllib",   "usemtl",   "usemap",     "maplib",   "lod", "mg",
    "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name)
      : cursor_(bytes, TextCursor::Rule::kHashCommentsContinued), name_(name) {}

  PolygonSoup read() {
    do {
      const std::string_view keyword = cursor_.word_of_line();
      if (keyword.empty()) continue;
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f" || keyword == "fo") {
        read_face();
      } else if (std::ranges::find(kNoSurface, keyword) == kNoSurface.end()) {
        leave_out(keyword);
      }
    } while (cursor_.next_line());
    for (const Ahead& ahead : ahead_)
      if (ahead.vertex > soup_.points.size())
        refuse_face(ahead.face,
                    names(ahead.vertex) + "the file has " + std::to_string(soup_.points.size()));
    if (soup_.size() == 0) refuse(" holds no face");
    add_notes();
    return std::move(soup_);
  }

 private:
  /// A vertex, counted from 1, that a face names and that comes behind it, if it does.
  struct Ahead {
    std::size_t face, vertex;
  };
  /// The lines of one unknown keyword.
  struct LeftOut {
    std::string keyword;
    std::size_t lines, first_line;
  };
  static constexpr std::size_t kMostKeywords = 8;  // with a note of their own

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + what + "."); }
  [[noreturn]] void refuse_vertex(std::size_t line, const std::string& what) const {
    refuse(": vertex " + std::to_string(soup_.points.size()) + " (line " + std::to_string(line) +
           ")" + what);
  }
  [[noreturn]] void refuse_face(std::size_t face, const std::string& what) const {
    refuse(": " + soup_.place_of(face) + " " + what);
  }
  template <typename Number>
  static std::string names(Number vertex) {
    return "names the vertex " + std::to_string(vertex) + "; ";
  }

  void read_vertex() {
    const std::size_t line = cursor_.line();
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = cursor_.word_of_line();
      if (word.empty()) refuse_vertex(line, " has fewer than three coordinates");
      const std::optional<double> value = decimal<double>(word);
      if (!value) refuse_vertex(line, coordinate_fault(word));
      point[axis] = *value;
    }
    // A weight or a colour: whatever number it is. Another word is of a line that ran into this.
    for (std::string_view word; !(word = cursor_.word_of_line()).empty();)
      if (!looks_like_a_number(word))
        refuse_vertex(line, " has " + quoted_word(word) + " behind its coordinates");
    soup_.points.push_back(point);
  }

  void read_face() {
    soup_.lines.push_back(static_cast<std::uint32_t>(cursor_.line()));
    for (std::string_view word; !(word = cursor_.word_of_line()).empty();)
      soup_.corners.push_back(corner(word));
    soup_.ends.push_back(soup_.corners.size());
  }

  // The vertex of "7", "7/1" or "-4//3"; a negative number counts back from the last vertex so far.
  std::uint32_t corner(std::string_view word) {
    std::string_view index = word.substr(0, word.find('/'));
    if (index.size() > 1 && index[0] == '+' && index[1] != '-') index.remove_prefix(1);
    const auto value = text::whole_number<std::int64_t>(index);
    const std::size_t face = soup_.size();
    if (!value)
      refuse_face(face, "has the vertex index " + quoted_word(word) + ", which is no whole number");
    if (*value == 0) refuse_face(face, names(0) + "they count from 1");
    const auto so_far = static_cast<std::int64_t>(soup_.points.size());
    if (*value < -so_far)
      refuse_face(face,
                  names(*value) + "the file has " + std::to_string(so_far) + " before that line");
    if (*value < 0) return static_cast<std::uint32_t>(so_far + *value);
    if (*value > so_far) ahead_.push_back({face, static_cast<std::size_t>(*value)});
    // A file of at most 2^32 bytes has fewer vertices: what is cut off here is refused at its end.
    constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(std::min(*value, kMost) - 1);
  }

  void leave_out(std::string_view keyword) {
    // FCL's files begin with their numbers of vertices and faces; elsewhere a line was broken.
    if (looks_like_a_number(keyword) && !soup_.points.empty())
      refuse(": line " + std::to_string(cursor_.line()) + " begins with " + quoted_word(keyword) +
             ", which is no keyword");
    const auto known = std::ranges::find(left_out_, keyword, &LeftOut::keyword);
    if (known != left_out_.end()) {
      ++known->lines;
    } else if (left_out_.size() < kMostKeywords) {
      left_out_.push_back({std::string(keyword), 1, cursor_.line()});
    } else {
      ++other_lines_;
    }
  }

  void add_notes() {
    for (const LeftOut& left_out : left_out_)
      add_note(soup_.notes, std::to_string(left_out.lines) +
                                (left_out.lines == 1 ? " line " : " lines ") +
                                quoted_word(left_out.keyword) + " left out" +
                                (left_out.lines == 1 ? " (line " : " (the first is line ") +
                                std::to_string(left_out.first_line) + ")");
    if (other_lines_ > 0)
      add_note(soup_.notes, std::to_string(other_lines_) + " lines of other keywords left out");
  }

  TextCursor cursor_;
  const std::string& name_;
  PolygonSoup soup_;
  std::vector<Ahead> ahead_;
  std::vector<LeftOut> left_out_;
  std::size_t other_lines_ = 0;
};

}  // namespace

PolygonSoup read_obj(std::string_view bytes, const std::string& name) {
  return ObjReader(bytes, name).read();
}

}  // namespace contactcheck::mesh
