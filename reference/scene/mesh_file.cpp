#include "reference/scene/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <limits>
#include <new>
#include <optional>

#include "core/types/check.h"
#include "reference/scene/assimp_reader.h"
#include "reference/scene/file_text.h"
#include "reference/scene/mesh_check.h"
#include "reference/scene/polygon_split.h"
#include "reference/scene/soup_guard.h"

namespace contactcheck {
namespace {

std::optional<SoupFormat> format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return SoupFormat::kObj;
  if (extension == ".off") return SoupFormat::kOff;
  if (extension == ".ply") return SoupFormat::kPly;
  if (extension == ".stl") return SoupFormat::kStl;
  return std::nullopt;
}

void refuse_lying_counts(SoupFormat format, const std::string& bytes, const std::string& name) {
  const std::optional<SoupCounts> counts = claimed_counts(format, bytes);
  if (!counts) return;
  // A vertex or face takes at least two bytes: a larger number would only exhaust the memory.
  if (counts->vertices > bytes.size() || counts->faces > bytes.size()) {
    throw InputError(name + " claims " + std::to_string(counts->vertices) + " vertices and " +
                     std::to_string(counts->faces) + " faces, more than its " +
                     std::to_string(bytes.size()) + " bytes can hold.");
  }
}

void refuse_lost_parts(SoupFormat format, const std::string& bytes, const std::string& name,
                       const PolygonSoup& soup) {
  const std::optional<SoupCounts> counts = claimed_counts(format, bytes);
  if (counts && (counts->vertices != soup.points.size() || counts->faces != soup.polygons.size())) {
    throw InputError(name + " claims " + std::to_string(counts->vertices) + " vertices and " +
                     std::to_string(counts->faces) + " faces but holds " +
                     std::to_string(soup.points.size()) + " and " +
                     std::to_string(soup.polygons.size()) + ".");
  }
  if (const std::size_t line = face_line_fault(format, bytes, soup)) {
    throw InputError(name + " has a face on line " + std::to_string(line) +
                     " whose vertex indices cannot all be read.");
  }
}

void refuse_bad_values(const PolygonSoup& soup, const std::string& name) {
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (soup.points[v].allFinite()) continue;
    throw InputError(name + ": vertex " + std::to_string(v) +
                     " has a coordinate that is not a finite number.");
  }
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    for (const std::uint32_t index : soup.polygons[f]) {
      if (index < soup.points.size()) continue;
      const bool known = index < std::numeric_limits<std::uint32_t>::max();  // else cut off
      throw InputError(name + ": face " + std::to_string(f) + " names " +
                       (known ? "the vertex " + std::to_string(index) : "no vertex") +
                       "; the file has " + std::to_string(soup.points.size()) +
                       ", counted from 0.");
    }
  }
}

/// How many polygons were split in which way.
struct SplitCounts {
  std::size_t all = 0, concave = 0, crossing = 0, dropped = 0;
};

std::vector<Triangle> triangles_of(const PolygonSoup& soup, std::size_t face,
                                   const std::string& name, SplitCounts& counts) {
  const std::vector<std::uint32_t>& polygon = soup.polygons[face];
  auto split = split_polygon(soup.points, polygon);
  // Warped, or flat to rounding: either diagonal gives a surface of the four corners.
  if (!split && polygon.size() == 4) {
    ++counts.crossing;
    return {{polygon[0], polygon[1], polygon[2]}, {polygon[0], polygon[2], polygon[3]}};
  }
  if (!split) {
    const std::string place = name + ": face " + std::to_string(face) + ", a polygon of " +
                              std::to_string(polygon.size()) + " corners, ";
    if (polygon.size() > kMostConcaveCorners)
      throw InputError(place + "is concave; concave polygons may have at most " +
                       std::to_string(kMostConcaveCorners) + " corners.");
    throw InputError(place + "crosses or folds back on itself and cannot be split into triangles.");
  }
  counts.concave += split->concave ? 1 : 0;
  return std::move(split->triangles);
}

void add_notes(const SplitCounts& counts, std::string& notes) {
  std::string split = std::to_string(counts.all) + " polygons split into triangles";
  if (counts.concave > 0) split += ", " + std::to_string(counts.concave) + " of them concave";
  if (counts.crossing > 0)
    split += ", " + std::to_string(counts.crossing) + " of four corners cross themselves";
  if (counts.all > 0) add_note(notes, split);
  if (counts.dropped > 0)
    add_note(notes,
             std::to_string(counts.dropped) + " faces with fewer than three corners left out");
}

LoadedMesh triangulated(const PolygonSoup& soup, const std::string& name) {
  LoadedMesh out;
  out.mesh.vertices = soup.points;
  SplitCounts counts;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const std::size_t corners = soup.polygons[f].size();
    counts.all += corners > 3 ? 1 : 0;
    counts.dropped += corners < 3 ? 1 : 0;
    if (corners < 3) continue;
    const std::vector<Triangle> triangles = triangles_of(soup, f, name, counts);
    out.mesh.triangles.insert(out.mesh.triangles.end(), triangles.begin(), triangles.end());
  }
  add_notes(counts, out.notes);
  return out;
}

}  // namespace

void add_note(std::string& notes, const std::string& note) {
  if (note.empty()) return;
  notes += (notes.empty() ? "" : "; ") + note;
}

namespace {

PolygonSoup read_soup(SoupFormat format, const std::string& bytes, const std::string& name) {
  refuse_lying_counts(format, bytes, name);
  // Checked first: CGAL would weld a NaN of a binary STL to any other vertex.
  if (format == SoupFormat::kStl) {
    const std::string more = bytes_beyond_stl(bytes);
    if (!more.empty()) throw InputError(name + more + ".");
    const std::string fault = coordinate_fault(format, bytes);
    if (!fault.empty()) throw InputError(name + ": " + fault + ".");
  }
  const std::string index_fault = face_index_fault(format, bytes);
  if (!index_fault.empty()) throw InputError(name + ": " + index_fault + ".");
  PolygonSoup soup;
  std::string guard_fault;
  const std::optional<std::string> guarded = guarded_bytes(format, bytes, guard_fault);
  if (!guard_fault.empty()) throw InputError(name + guard_fault + ".");
  if (!guarded || !read_polygon_soup(format, *guarded, soup)) {
    const std::string fault = coordinate_fault(format, bytes);
    if (!fault.empty()) throw InputError(name + ": " + fault + ".");
    throw InputError(name + " cannot be read as " + name_of(format) + ".");
  }
  refuse_lost_parts(format, bytes, name, soup);
  refuse_bad_values(soup, name);
  return soup;
}

// A file is refused with a sentence that names it, whatever reading it throws: memory runs out, or
// a check of a library's. The fuzzer goes by read_mesh_bytes() and still finds what we throw.
template <typename Read>
auto with_sentences(const std::filesystem::path& file, Read read) {
  const std::string name = "mesh file " + in_quotes(file.string());
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

LoadedMesh read_mesh_bytes(SoupFormat format, const std::string& bytes, const std::string& name) {
  LoadedMesh out = triangulated(read_soup(format, bytes, name), name);
  if (out.mesh.triangles.empty()) throw InputError(name + " holds no triangle.");
  if (format == SoupFormat::kStl) add_note(out.notes, "STL: corners at equal places joined");
  return out;
}

PolygonSoup read_polygons(const std::filesystem::path& file) {
  return with_sentences(file, [&](const std::string& name) {
    const std::string bytes = read_file_bytes(file, "mesh file", kLongestMesh);
    PolygonSoup out;
    if (const std::optional<SoupFormat> format = format_of(file)) {
      out = read_soup(*format, bytes, name);
      std::erase_if(out.polygons, [](const auto& polygon) { return polygon.size() < 3; });
      return out;
    }
    const TriangleMesh mesh = read_with_assimp(file).mesh;
    out.points = mesh.vertices;
    for (const Triangle& t : mesh.triangles) out.polygons.emplace_back(t.begin(), t.end());
    return out;
  });
}

LoadedMesh read_mesh_file(const std::filesystem::path& file) {
  return with_sentences(file, [&](const std::string& name) {
    const std::string bytes = read_file_bytes(file, "mesh file", kLongestMesh);
    const std::optional<SoupFormat> format = format_of(file);
    return format ? read_mesh_bytes(*format, bytes, name) : read_with_assimp(file);
  });
}

}  // namespace contactcheck
