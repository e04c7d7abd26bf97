// Vertices and faces as in a mesh file, and a reader for each format that we read without assimp.
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
  /// By polygon: its line, from 1; empty for binary files and for faces without a line.
  /// kLongestMesh = 2^32 bytes bounds the numbers of lines.
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
  /// "face 3 (line 10)", with faces counted from 0, or "face 3".
  std::string place_of(std::size_t i) const;
};

// The readers. Each takes the bytes of a whole file; `name` denotes it in messages ("mesh file
// \"a.obj\""). Texts are read by text_cursor.h: numbers are rounded to the nearest double, and
// other words are named with their line. Polygons may have fewer than three corners.
// @throws InputError, one sentence: name, vertex, face or line, word

/// Wavefront OBJ: `v`, `f` and `fo`. Normals, texture coordinates, groups and materials are left
/// out, other keywords too, with one note per keyword.
PolygonSoup read_obj(std::string_view bytes, const std::string& name);
/// Geomview's OFF, text or binary, with any of the prefixes ST, C, N, 4 and n (if it says 3
/// dimensions); the keyword may be missing, and the counts may follow it without a blank. Normals,
/// colours and texture coordinates are left out.
PolygonSoup read_off(std::string_view bytes, const std::string& name);
/// PLY, text or binary in either byte order: vertices, faces and triangle strips. Float properties
/// are rounded to float. In text each element ends its line.
PolygonSoup read_ply(std::string_view bytes, const std::string& name);
/// STL, binary or text in any case, recognised by size and content. Every triangle has separate
/// corners: points 3 i to 3 i + 2.
PolygonSoup read_stl(std::string_view bytes, const std::string& name);

/// Calls the reader of the format. Refuses a text in UTF-16, and says so.
PolygonSoup read_soup(SoupFormat format, std::string_view bytes, const std::string& name);

/// Appends a remark to notes that are joined by "; ".
void add_note(std::string& notes, const std::string& note);

}  // namespace contactcheck::mesh
