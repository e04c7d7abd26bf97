// Vertices and faces as they stand in a mesh file, and one reader for each format that we read
// ourselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck::mesh {

enum class SoupFormat { kObj, kOff, kPly, kStl };

const char* name_of(SoupFormat format);

struct PolygonSoup {
  std::vector<Vec3> points;  ///< finite
  std::vector<std::uint32_t>
      corners;                    ///< of all polygons, one after the other: below points.size()
  std::vector<std::size_t> ends;  ///< by polygon: where its corners end in `corners`
  /// By polygon: its line, from 1. Empty for binary files and for what is no line's. A file of at
  /// most kLongestMesh = 2^32 bytes has no later line with a face.
  std::vector<std::uint32_t> lines;
  std::string notes;  ///< what was left out; may be empty

  std::size_t size() const { return ends.size(); }
  std::span<const std::uint32_t> polygon(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return {corners.data() + begin, ends[i] - begin};
  }
  void add(std::span<const std::uint32_t> polygon) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    ends.push_back(corners.size());
  }
  /// "face 3 (line 10)", counted from 0, or "face 3".
  std::string place_of(std::size_t i) const;
};

// The readers. Each takes the bytes of a whole file; `name` stands for it in messages ("mesh file
// \"a.obj\""). Texts are read by text_cursor.h: numbers rounded to the nearest double, words that
// are none named with their line. Polygons may have fewer than three corners.
// @throws InputError, one sentence: name, vertex, face or line, word

/// Wavefront OBJ: `v`, `f` and `fo`. Normals, texture coordinates, groups and materials are left
/// out, lines of any other keyword with a note for each keyword.
PolygonSoup read_obj(std::string_view bytes, const std::string& name);
/// Geomview's OFF, text or binary, with any of the prefixes ST, C, N, 4 and n (of three
/// dimensions); the keyword may be missing, and the counts may follow it without a blank. Normals,
/// colours and texture coordinates are left out.
PolygonSoup read_off(std::string_view bytes, const std::string& name);
/// PLY, text or binary of either order of bytes: vertices, faces and triangle strips. Values that
/// are floats are those of the floats. In text each element ends its line.
PolygonSoup read_ply(std::string_view bytes, const std::string& name);
/// STL, binary or text in any case, told by size and content. Every triangle has corners of its
/// own: points 3 i to 3 i + 2.
PolygonSoup read_stl(std::string_view bytes, const std::string& name);

/// By the format. A text in UTF-16 is refused with that word.
PolygonSoup read_soup(SoupFormat format, std::string_view bytes, const std::string& name);

/// Appends a remark to notes that are joined by "; ".
void add_note(std::string& notes, const std::string& note);

}  // namespace contactcheck::mesh
