#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "reference/mesh/polygon_soup.h"
#include "reference/mesh/text_cursor.h"
#include "reference/text/words.h"

namespace contactcheck::mesh {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct TypeNames {
  const char *name, *sized_name;
  Type type;
  std::size_t size;              // bytes in a binary file
  std::int64_t lowest, highest;  // of whole numbers
};

constexpr TypeNames kTypes[] = {{"char", "int8", Type::kInt8, 1, -128, 127},
                                {"uchar", "uint8", Type::kUint8, 1, 0, 255},
                                {"short", "int16", Type::kInt16, 2, -32768, 32767},
                                {"ushort", "uint16", Type::kUint16, 2, 0, 65535},
                                {"int", "int32", Type::kInt32, 4, -2147483648, 2147483647},
                                {"uint", "uint32", Type::kUint32, 4, 0, 4294967295},
                                {"float", "float32", Type::kFloat, 4, 0, 0},
                                {"double", "float64", Type::kDouble, 8, 0, 0}};

const TypeNames* type_of(std::string_view word) {
  for (const TypeNames& names : kTypes)
    if (word == names.name || word == names.sized_name) return &names;
  return nullptr;
}

bool is_floating(const TypeNames& type) {
  return type.type == Type::kFloat || type.type == Type::kDouble;
}

/// What a value is read for.
enum class Role { kNothing, kX, kY, kZ, kCorners };

struct Property {
  const TypeNames* length = nullptr;  // of a list
  const TypeNames* item = nullptr;
  std::string name;
  Role role = Role::kNothing;
};

struct Element {
  enum class Kind { kOther, kVertex, kFace, kStrips };
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
  Kind kind = Kind::kOther;

  bool has(Role role) const {
    return std::ranges::find(properties, role, &Property::role) != properties.end();
  }
};

enum class Encoding { kText, kLittleEndian, kBigEndian };

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), cursor_(bytes), name_(name) {}

  PolygonSoup read() {
    read_header();
    check_header();
    if (encoding_ != Encoding::kText) skip_line_end();
    for (const Element& element : elements_) {
      for (std::size_t i = 0; i < element.count; ++i) {
        element_ = &element;
        index_ = i;
        if (encoding_ == Encoding::kText)
          read_text_element();
        else
          read_binary_element();
      }
    }
    refuse_more();
    if (strip_triangles_ > 0)
      add_note(soup_.notes, std::to_string(strip_triangles_) + " triangles of strips");
    return std::move(soup_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + what + "."); }

  // "vertex 2", of the element that is read.
  std::string element_text() const {
    const char* const names[] = {"", "vertex", "face", "strip"};
    const auto kind = static_cast<std::size_t>(element_->kind);
    return (kind == 0 ? quoted_word(element_->name) : names[kind]) + " " + std::to_string(index_);
  }
  std::string place() const {
    return element_text() +
           (encoding_ == Encoding::kText ? " (line " + std::to_string(cursor_.line()) + ")" : "");
  }
  [[noreturn]] void refuse_end() const {
    refuse(" ends within " + element_text() + " of " + std::to_string(element_->count));
  }

  [[noreturn]] void refuse_header(const std::string& what) const {
    refuse(": line " + std::to_string(cursor_.line()) + " of its header " + what);
  }

  // Leaves the cursor at the end of the line "end_header".
  void read_header() {
    if (cursor_.word_of_line() != "ply") refuse(" is no PLY: it does not begin with \"ply\"");
    bool has_format = false;
    while (cursor_.next_line()) {
      const std::string_view keyword = cursor_.word_of_line();
      if (keyword.empty() || keyword == "comment" || keyword == "obj_info") {
        continue;
      } else if (keyword == "format") {
        if (std::exchange(has_format, true)) refuse_header("is a second format");
        read_format();
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (keyword == "end_header") {
        if (!has_format) refuse(" has a header without a format");
        return;
      } else {
        refuse_header("begins with " + quoted_word(keyword) + ", which is no keyword");
      }
    }
    refuse(" has a header without an end");
  }

  void read_format() {
    const std::string_view word = cursor_.word_of_line();
    if (word == "ascii")
      encoding_ = Encoding::kText;
    else if (word == "binary_little_endian")
      encoding_ = Encoding::kLittleEndian;
    else if (word == "binary_big_endian")
      encoding_ = Encoding::kBigEndian;
    else
      refuse_header("has the format " + quoted_word(word) +
                    "; it is ascii, binary_little_endian or binary_big_endian");
  }

  void read_element() {
    const std::string_view name = cursor_.word_of_line(), number = cursor_.word_of_line();
    const auto count = text::whole_number<std::size_t>(number);
    if (!count) refuse_header("has " + quoted_word(number) + " as a number of elements");
    Element element{std::string(name), *count, {}, Element::Kind::kOther};
    if (name == "vertex" || name == "vertices") element.kind = Element::Kind::kVertex;
    if (name == "face" || name == "faces") element.kind = Element::Kind::kFace;
    if (name == "tristrips" || name == "tristrip") element.kind = Element::Kind::kStrips;
    elements_.push_back(std::move(element));
  }

  void read_property() {
    if (elements_.empty()) refuse_header("is a property of no element");
    Property property;
    std::string_view word = cursor_.word_of_line();
    const auto type = [&] {
      const TypeNames* const out = type_of(word);
      if (out == nullptr)
        refuse_header("has the type " + quoted_word(word) + ", which PLY does not know");
      return out;
    };
    if (word == "list") {
      word = cursor_.word_of_line();
      property.length = type();
      if (is_floating(*property.length)) refuse_header("is a list whose length is no whole number");
      word = cursor_.word_of_line();
    }
    property.item = type();
    property.name = cursor_.word_of_line();
    if (property.name.empty()) refuse_header("is a property without a name");
    set_role(property);
    elements_.back().properties.push_back(std::move(property));
  }

  // The first of a name counts. Files disagree on the name of the list of corners.
  void set_role(Property& property) const {
    const Element& element = elements_.back();
    Role role = Role::kNothing;
    if (element.kind == Element::Kind::kVertex) {
      role = property.name == "x"   ? Role::kX
             : property.name == "y" ? Role::kY
             : property.name == "z" ? Role::kZ
                                    : Role::kNothing;
      if (role != Role::kNothing && property.length)
        refuse_header("is a list of coordinates; each is one number");
    } else if (element.kind != Element::Kind::kOther &&
               (property.name == "vertex_indices" || property.name == "vertex_index")) {
      role = Role::kCorners;
      if (!property.length || is_floating(*property.item))
        refuse_header("has vertex indices that are no list of whole numbers");
    }
    if (!element.has(role)) property.role = role;
  }

  void check_header() {
    std::array<std::size_t, 4> of_kind{};
    for (const Element& element : elements_) {
      // An element takes a byte at least: a larger number would only exhaust the memory.
      if (element.count > bytes_.size())
        refuse(" claims " + std::to_string(element.count) + " elements " +
               quoted_word(element.name) + ", more than its " + std::to_string(bytes_.size()) +
               " bytes can hold");
      if (element.kind == Element::Kind::kVertex) vertices_ = element.count;
      const auto kind = static_cast<std::size_t>(element.kind);
      if (++of_kind[kind] > 1 && element.kind == Element::Kind::kVertex)
        refuse(" has more than one element of vertices");
      if (of_kind[kind] > 1 && element.kind == Element::Kind::kFace)
        refuse(" has more than one element of faces");
      if (element.kind == Element::Kind::kVertex)
        for (const auto& [role, name] :
             {std::pair{Role::kX, "x"}, {Role::kY, "y"}, {Role::kZ, "z"}})
          if (!element.has(role)) refuse(std::string(" has vertices without a property ") + name);
      if (element.kind != Element::Kind::kVertex && element.kind != Element::Kind::kOther &&
          element.count > 0 && !element.has(Role::kCorners))
        refuse(" has an element " + quoted_word(element.name) +
               " without a list of vertex indices");
    }
  }

  // The bytes of a binary file may begin with one that ends lines, too: how lines of the header
  // end tells whether it is theirs.
  void skip_line_end() {
    at_ = cursor_.offset();
    while (at_ < bytes_.size() && (bytes_[at_] == ' ' || bytes_[at_] == '\t')) ++at_;
    const std::size_t first = bytes_.find_first_of("\r\n");
    const bool by_cr = bytes_[first] == '\r' && bytes_[first + 1] != '\n';
    const std::string_view rest = bytes_.substr(at_);
    if (rest.starts_with("\n") || (by_cr && rest.starts_with("\r")))
      ++at_;
    else if (rest.starts_with("\r\n"))
      at_ += 2;
    else
      refuse(" has no end of line behind \"end_header\"");
  }

  void read_text_element() {
    point_ = Vec3::Zero();
    for (const Property& property : element_->properties) {
      if (!property.length) {
        read_text_value(property);
        continue;
      }
      const std::int64_t length = whole_word(next_word(), *property.length, "the length of a list");
      if (length < 0)
        refuse(": " + place() + " has a list of " + std::to_string(length) + " values");
      indices_.clear();
      for (std::int64_t i = 0; i < length; ++i) {
        if (property.role == Role::kCorners)
          indices_.push_back(whole_word(next_word(), *property.item, "a vertex index"));
        else
          leave_out(next_word());
      }
      if (property.role == Role::kCorners) take_polygon();
    }
    const std::string rest(cursor_.rest_of_line());
    if (!rest.empty())
      refuse(": " + place() + " has more on its line than its properties: " + quoted_word(rest));
    if (element_->kind == Element::Kind::kVertex) soup_.points.push_back(point_);
  }

  void read_text_value(const Property& property) {
    const std::string_view word = next_word();
    if (property.role == Role::kNothing) return leave_out(word);
    double& out = coordinate(property.role);
    if (!is_floating(*property.item)) {
      out = static_cast<double>(whole_word(word, *property.item, "a coordinate"));
      return;
    }
    std::optional<double> value;
    if (property.item->type == Type::kFloat)
      value = decimal<float>(word);
    else
      value = decimal<double>(word);
    if (!value) refuse(": " + place() + coordinate_fault(word));
    out = *value;
  }

  std::string_view next_word() {
    const std::string_view word = cursor_.word();
    if (word.empty()) refuse_end();
    return word;
  }

  // Some programs write whole numbers with decimals; values that are not used may have them.
  void leave_out(std::string_view word) const {
    if (!looks_like_a_number(word))
      refuse(": " + place() + " has " + quoted_word(word) + " in place of a number");
  }

  std::int64_t whole_word(std::string_view word, const TypeNames& type, const char* what) const {
    const auto value = text::whole_number<std::int64_t>(word);
    if (!value || *value < type.lowest || *value > type.highest)
      refuse(": " + place() + " has " + quoted_word(word) + " as " + what + ", which is no " +
             type.name);
    return *value;
  }

  double& coordinate(Role role) { return point_[role == Role::kX ? 0 : role == Role::kY ? 1 : 2]; }

  void read_binary_element() {
    for (const Property& property : element_->properties) {
      if (!property.length) {
        const double value = next_value(*property.item);
        if (property.role == Role::kNothing) continue;
        if (!std::isfinite(value)) refuse(": " + place() + coordinate_fault(value));
        coordinate(property.role) = value;
        continue;
      }
      const double length = next_value(*property.length);  // of 32 bits: whole and exact
      if (length < 0.0)
        refuse(": " + place() + " has a list of " +
               std::to_string(static_cast<std::int64_t>(length)) + " values");
      const auto items = static_cast<std::size_t>(length);
      if (property.role != Role::kCorners) {
        if (items > (bytes_.size() - at_) / property.item->size) refuse_end();
        at_ += items * property.item->size;
        continue;
      }
      indices_.clear();
      for (std::size_t i = 0; i < items; ++i)
        indices_.push_back(static_cast<std::int64_t>(next_value(*property.item)));
      take_polygon();
    }
    if (element_->kind == Element::Kind::kVertex) soup_.points.push_back(point_);
  }

  double next_value(const TypeNames& type) {
    if (bytes_.size() - at_ < type.size) refuse_end();
    const std::uint64_t bits = text::whole_of_bytes(
        bytes_.substr(at_, type.size),
        encoding_ == Encoding::kBigEndian ? std::endian::big : std::endian::little);
    at_ += type.size;
    switch (type.type) {
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

  void take_polygon() {
    if (element_->kind == Element::Kind::kStrips) return take_strips();
    for (const std::int64_t index : indices_) soup_.corners.push_back(vertex_of(index));
    end_polygon();
  }

  std::uint32_t vertex_of(std::int64_t index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= vertices_)
      refuse(": " + place() + " " + names_no_vertex(index, vertices_));
    return static_cast<std::uint32_t>(index);
  }

  void end_polygon() {
    soup_.ends.push_back(soup_.corners.size());
    if (encoding_ == Encoding::kText)
      soup_.lines.push_back(static_cast<std::uint32_t>(cursor_.line()));
  }

  // Every second triangle is turned; -1 begins a new strip, and a corner twice only leads on.
  void take_strips() {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      if (indices_[i] == -1 || indices_[i] == std::numeric_limits<std::uint32_t>::max()) {
        begin = i + 1;
        continue;
      }
      const std::uint32_t c = vertex_of(indices_[i]);
      if (i < begin + 2) continue;
      std::uint32_t a = vertex_of(indices_[i - 2]), b = vertex_of(indices_[i - 1]);
      if (a == b || b == c || c == a) continue;
      if ((i - begin) % 2 == 1) std::swap(a, b);
      soup_.corners.insert(soup_.corners.end(), {a, b, c});
      end_polygon();
      ++strip_triangles_;
    }
  }

  // White space may follow.
  void refuse_more() {
    if (encoding_ == Encoding::kText) {
      std::string_view rest = cursor_.rest_of_line();
      while (rest.empty() && cursor_.next_line()) rest = cursor_.rest_of_line();
      if (rest.empty()) return;
      refuse(" goes on after the last element of its header (line " +
             std::to_string(cursor_.line()) + "): " + quoted_word(rest));
    }
    const std::string_view rest = bytes_.substr(at_);
    if (rest.find_first_not_of(" \t\r\n") != std::string_view::npos)
      refuse(" has " + std::to_string(rest.size()) + " bytes more than its header says");
  }

  std::string_view bytes_;
  TextCursor cursor_;
  const std::string& name_;
  Encoding encoding_ = Encoding::kText;
  std::vector<Element> elements_;
  std::size_t vertices_ = 0;
  std::size_t at_ = 0;  // in a binary file

  const Element* element_ = nullptr;  // that is read, and which one of them
  std::size_t index_ = 0;
  Vec3 point_ = Vec3::Zero();
  std::vector<std::int64_t> indices_;

  PolygonSoup soup_;
  std::size_t strip_triangles_ = 0;
};

}  // namespace

PolygonSoup read_ply(std::string_view bytes, const std::string& name) {
  return PlyReader(bytes, name).read();
}

}  // namespace contactcheck::mesh
