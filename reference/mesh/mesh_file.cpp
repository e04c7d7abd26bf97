#include "reference/mesh/mesh_file.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "core/types/vertex_places.h"
#include "reference/mesh/foreign_file.h"
#include "reference/mesh/polygon_split.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::mesh {
namespace {

std::optional<SoupFormat> format_of(const std::filesystem::path& file) {
  const std::string extension = text::lower_extension(file);
  if (extension == ".obj") return SoupFormat::kObj;
  if (extension == ".off") return SoupFormat::kOff;
  if (extension == ".ply") return SoupFormat::kPly;
  if (extension == ".stl") return SoupFormat::kStl;
  return std::nullopt;
}

// For STL: points at equal coordinates become the first of them.
void join_corners(PolygonSoup& soup) {
  const std::vector<std::uint32_t> first = first_at_place(soup.points);
  std::vector<std::uint32_t> joined(soup.points.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      joined[i] = count;
      soup.points[count++] = soup.points[i];
    }
    soup.corners[i] = joined[first[i]];
  }
  soup.points.resize(count);
}

// "face 1 (line 7), of 5 corners, crosses or folds back on itself: left out (...)"
std::string note_of_folded(const PolygonSoup& soup, const std::vector<std::size_t>& folded,
                           Folded rule) {
  const bool one = folded.size() == 1;
  const std::size_t corners = soup.polygon(folded[0]).size();
  const std::string first = soup.place_of(folded[0]),
                    of_corners = " of " + std::to_string(corners) + " corners",
                    fan = one ? "a fan" : "fans";
  const char* const concave = corners > kMostConcaveCorners ? "is concave, " : "";
  return (one ? first + "," + of_corners + ", " + concave + "crosses or folds back on itself"
              : std::to_string(folded.size()) +
                    " polygons cross or fold back on themselves, first " + first + of_corners) +
         (rule == Folded::kFanned
              ? ": filled by " + fan
              : std::string(": left out (--repair, in a scene \"repair\": true, fills ") +
                    (one ? "it" : "them") + " by " + fan + ")");
}

LoadedMesh triangulated(PolygonSoup soup, Folded rule) {
  LoadedMesh out;
  std::vector<Triangle>& triangles = out.mesh.triangles;
  triangles.reserve(soup.size());
  std::size_t polygons = 0, concave = 0, crossing = 0, dropped = 0;
  std::vector<std::size_t> folded;
  for (std::size_t f = 0; f < soup.size(); ++f) {
    const std::span<const std::uint32_t> polygon = soup.polygon(f);
    if (polygon.size() < 3) {
      ++dropped;
      continue;
    }
    if (polygon.size() == 3) {
      triangles.push_back({polygon[0], polygon[1], polygon[2]});
      continue;
    }
    ++polygons;
    if (const std::optional<SplitPolygon> split = split_polygon(soup.points, polygon)) {
      concave += split->concave ? 1 : 0;
      triangles.insert(triangles.end(), split->triangles.begin(), split->triangles.end());
      continue;
    }
    // Four corners are warped, or flat to rounding: either diagonal gives a surface of theirs.
    crossing += polygon.size() == 4 ? 1 : 0;
    if (polygon.size() > 4) folded.push_back(f);
    if (polygon.size() > 4 && rule == Folded::kLeftOut) continue;
    for (std::size_t k = 2; k < polygon.size(); ++k)
      triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
  }
  out.notes = soup.notes;
  polygons -= folded.size();
  std::string note = text::counted(polygons, "polygon") + " split into triangles";
  if (concave > 0) note += ", " + std::to_string(concave) + " of them concave";
  if (crossing > 0) note += ", " + std::to_string(crossing) + " of four corners cross themselves";
  if (polygons > 0) add_note(out.notes, note);
  if (!folded.empty()) add_note(out.notes, note_of_folded(soup, folded, rule));
  if (dropped > 0)
    add_note(out.notes, text::counted(dropped, "face") + " with fewer than three corners left out");
  out.mesh.vertices = std::move(soup.points);
  if (rule == Folded::kLeftOut) out.unfilled = std::move(folded);
  return out;
}

// A file is refused with a sentence that names it, whatever reading it throws: memory runs out, or
// a check of a library's. The fuzzer goes by read_mesh_bytes() and still finds what we throw.
template <typename Read>
auto with_sentences(const std::filesystem::path& file, Read read) {
  const std::string name = "mesh file " + text::in_quotes(file.string());
  try {
    return read(name);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw InputError(name + " cannot be read: it takes more memory than there is.");
  } catch (const std::exception& e) {
    throw InputError(name + " cannot be read: " + e.what() + ".");
  }
}

}  // namespace

const char* name_of(SoupFormat format) {
  switch (format) {
    case SoupFormat::kObj:
      return "OBJ";
    case SoupFormat::kOff:
      return "OFF";
    case SoupFormat::kPly:
      return "PLY";
    case SoupFormat::kStl:
      return "STL";
  }
  return "unknown";
}

std::string PolygonSoup::place_of(std::size_t i) const {
  return "face " + std::to_string(i) +
         (i < lines.size() ? " (line " + std::to_string(lines[i]) + ")" : "");
}

PolygonSoup read_soup(SoupFormat format, std::string_view bytes, const std::string& name) {
  // A binary STL may begin with any bytes.
  if (format != SoupFormat::kStl &&
      (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")))
    throw InputError(name + " is a text in UTF-16; it must be in UTF-8.");
  switch (format) {
    case SoupFormat::kObj:
      return read_obj(bytes, name);
    case SoupFormat::kOff:
      return read_off(bytes, name);
    case SoupFormat::kPly:
      return read_ply(bytes, name);
    case SoupFormat::kStl:
      return read_stl(bytes, name);
  }
  return {};
}

void add_note(std::string& notes, const std::string& note) {
  if (note.empty()) return;
  notes += (notes.empty() ? "" : "; ") + note;
}

void add_note_of_dropped(std::string& notes, std::size_t vertices) {
  if (vertices == 0) return;
  add_note(notes,
           text::counted(vertices, "vertex", "vertices") + " that no triangle uses, dropped");
}

bool has_own_corners(const std::filesystem::path& file) {
  return format_of(file) == SoupFormat::kStl;
}

LoadedMesh read_mesh_bytes(SoupFormat format, std::string_view bytes, const std::string& name,
                           Folded folded) {
  PolygonSoup soup = read_soup(format, bytes, name);
  if (format == SoupFormat::kStl) {
    join_corners(soup);
    add_note(soup.notes, "STL: corners at equal places joined");
  }
  LoadedMesh out = triangulated(std::move(soup), folded);
  if (out.mesh.triangles.empty())
    throw InputError(name + " holds no triangle" + (out.unfilled.empty() ? "" : ": " + out.notes) +
                     ".");
  return out;
}

PolygonSoup read_polygons(const std::filesystem::path& file) {
  return with_sentences(file, [&](const std::string& name) {
    const std::string bytes = text::read_file_bytes(file, "mesh file", text::kLongestMesh);
    if (const std::optional<SoupFormat> format = format_of(file))
      return read_soup(*format, bytes, name);
    const TriangleMesh mesh = read_foreign_file(file, name).mesh;
    PolygonSoup out;
    out.points = mesh.vertices;
    for (const Triangle& t : mesh.triangles) out.add(t);
    return out;
  });
}

LoadedMesh read_mesh_file(const std::filesystem::path& file, Folded folded) {
  return with_sentences(file, [&](const std::string& name) {
    const std::string bytes = text::read_file_bytes(file, "mesh file", text::kLongestMesh);
    const std::optional<SoupFormat> format = format_of(file);
    return format ? read_mesh_bytes(*format, bytes, name, folded) : read_foreign_file(file, name);
  });
}

}  // namespace contactcheck::mesh
