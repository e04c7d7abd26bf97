#include "reference/mesh/mesh_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <new>
#include <optional>

#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/mesh/mesh_check.h"
#include "reference/mesh/off_guard.h"
#include "reference/mesh/ply.h"
#include "reference/mesh/polygon_split.h"
#include "reference/text/file_text.h"

namespace contactcheck::mesh {
namespace {

// The mesh formats that CGAL does not read (glTF, Collada, FBX, 3DS, ...), through assimp.

// Collects triangles; vertices with the same bits in all three coordinates are one.
class Welder {
 public:
  std::uint32_t vertex(const aiVector3D& p) {
    const std::array<std::uint32_t, 3> bits = {std::bit_cast<std::uint32_t>(p.x),
                                               std::bit_cast<std::uint32_t>(p.y),
                                               std::bit_cast<std::uint32_t>(p.z)};
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [it, is_new] = index_.try_emplace(bits, next);
    if (is_new) mesh.vertices.emplace_back(p.x, p.y, p.z);
    return it->second;
  }

  TriangleMesh mesh;

 private:
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> index_;
};

// A file may name others: the bytes of its vertices, for one.
class InputFiles : public Assimp::DefaultIOSystem {
 public:
  // assimp 5.2.5 opens a file to see whether it is there.
  bool Exists(const char* file) const override {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored);
  }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const std::string fault = input_file_fault(file);
    if (fault.empty()) return DefaultIOSystem::Open(file, mode);
    // What is missing is for assimp to tell: not all of it is needed.
    if (refused.empty() && Exists(file)) refused = text::in_quotes(file) + fault;
    return nullptr;
  }

  std::string refused;  ///< the first that is there and no regular file, and what it is
};

void refuse_non_finite(const aiMesh& part, std::size_t mesh_index, const std::string& name) {
  for (std::size_t v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw InputError(name + ": vertex " + std::to_string(v) + " of mesh " +
                     std::to_string(mesh_index) + " has a coordinate that is not a finite number.");
  }
}

// Lines and points of the file are no surface; their number is returned.
std::size_t add_part(const aiMesh& part, Welder& welder) {
  std::size_t skipped = 0;
  for (std::size_t f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) {
      ++skipped;
      continue;
    }
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = welder.vertex(part.mVertices[face.mIndices[k]]);
    }
    welder.mesh.triangles.push_back(triangle);
  }
  return skipped;
}

// Coordinates are floats (assimp 5.2.5) and the notes say so. Node transforms are applied, the
// meshes of the file become one, and vertices at bit-identical places become one: such formats
// split a vertex for each of its normals and texture coordinates, which would tear a closed
// surface open. Nothing else is joined, unlike assimp's own joining, which merges what is within
// 1e-6.
// @throws InputError with assimp's reason
LoadedMesh read_with_assimp(const std::filesystem::path& file) {
  const std::string name = "mesh file " + text::in_quotes(file.string());
  Assimp::Importer importer;
  auto* const files = new InputFiles;  // the importer owns it
  importer.SetIOHandler(files);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    std::string reason = files->refused.empty() ? importer.GetErrorString() : files->refused;
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) reason.pop_back();
    throw InputError(name + " cannot be read by assimp: " + reason + ".");
  }
  Welder welder;
  std::size_t corners = 0, skipped = 0;
  for (std::size_t m = 0; m < scene->mNumMeshes; ++m) {
    refuse_non_finite(*scene->mMeshes[m], m, name);
    skipped += add_part(*scene->mMeshes[m], welder);
    corners += scene->mMeshes[m]->mNumVertices;
  }
  if (welder.mesh.triangles.empty()) throw InputError(name + " holds no triangle.");
  LoadedMesh out{std::move(welder.mesh), "read as float by assimp"};
  if (out.mesh.vertices.size() < corners) {
    add_note(out.notes, std::to_string(corners - out.mesh.vertices.size()) +
                            " vertices at equal places joined");
  }
  if (skipped > 0) add_note(out.notes, std::to_string(skipped) + " lines and points left out");
  return out;
}

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

void refuse_lost_corners(SoupFormat format, const std::string& bytes, const std::string& name,
                         const PolygonSoup& soup) {
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

}  // namespace

void add_note(std::string& notes, const std::string& note) {
  if (note.empty()) return;
  notes += (notes.empty() ? "" : "; ") + note;
}

void add_note_of_dropped(std::string& notes, std::size_t vertices) {
  if (vertices == 0) return;
  add_note(notes, std::to_string(vertices) + (vertices == 1 ? " vertex" : " vertices") +
                      " that no triangle uses, dropped");
}

namespace {

LoadedMesh triangulated(const PolygonSoup& soup, const std::string& name) {
  LoadedMesh out;
  out.mesh.vertices = soup.points;
  std::vector<Triangle>& triangles = out.mesh.triangles;
  std::size_t polygons = 0, concave = 0, crossing = 0, dropped = 0;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const std::vector<std::uint32_t>& polygon = soup.polygons[f];
    polygons += polygon.size() > 3 ? 1 : 0;
    dropped += polygon.size() < 3 ? 1 : 0;
    if (polygon.size() < 3) continue;
    const std::optional<SplitPolygon> split = split_polygon(soup.points, polygon);
    if (split) {
      concave += split->concave ? 1 : 0;
      triangles.insert(triangles.end(), split->triangles.begin(), split->triangles.end());
    } else if (polygon.size() == 4) {
      // Warped, or flat to rounding: either diagonal gives a surface of the four corners.
      ++crossing;
      triangles.push_back({polygon[0], polygon[1], polygon[2]});
      triangles.push_back({polygon[0], polygon[2], polygon[3]});
    } else {
      const std::string place = name + ": face " + std::to_string(f) + ", a polygon of " +
                                std::to_string(polygon.size()) + " corners, ";
      if (polygon.size() > kMostConcaveCorners)
        throw InputError(place + "is concave; concave polygons may have at most " +
                         std::to_string(kMostConcaveCorners) + " corners.");
      throw InputError(place +
                       "crosses or folds back on itself and cannot be split into triangles.");
    }
  }
  std::string note = std::to_string(polygons) + " polygons split into triangles";
  if (concave > 0) note += ", " + std::to_string(concave) + " of them concave";
  if (crossing > 0) note += ", " + std::to_string(crossing) + " of four corners cross themselves";
  if (polygons > 0) add_note(out.notes, note);
  if (dropped > 0)
    add_note(out.notes, std::to_string(dropped) + " faces with fewer than three corners left out");
  return out;
}

bool has_obj_face(const std::string& bytes) {
  for (std::size_t line = 0; line < bytes.size(); line = bytes.find('\n', line), ++line) {
    const std::size_t word = bytes.find_first_not_of(" \t", line);
    if (word != std::string::npos && bytes[word] == 'f' && word + 1 < bytes.size() &&
        (bytes[word + 1] == ' ' || bytes[word + 1] == '\t'))
      return true;
    if (bytes.find('\n', line) == std::string::npos) break;
  }
  return false;
}

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
  std::string fault;
  bool read = false;
  if (format == SoupFormat::kPly) {
    read = read_ply(bytes, soup, fault);
  } else if (format == SoupFormat::kOff) {
    const std::optional<std::string> plain = plain_off(bytes, fault);
    read = plain && read_polygon_soup(format, *plain, soup);
  } else {
    read = read_polygon_soup(format, bytes, soup);
  }
  if (!fault.empty()) throw InputError(name + fault + ".");
  if (!read) {
    fault = coordinate_fault(format, bytes);
    if (!fault.empty()) throw InputError(name + ": " + fault + ".");
    if (format == SoupFormat::kObj && !has_obj_face(bytes))
      throw InputError(name + " holds no face.");
    throw InputError(name + " cannot be read as " + name_of(format) + ".");
  }
  refuse_lost_corners(format, bytes, name, soup);
  refuse_bad_values(soup, name);
  return soup;
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

LoadedMesh read_mesh_bytes(SoupFormat format, const std::string& bytes, const std::string& name) {
  LoadedMesh out = triangulated(read_soup(format, bytes, name), name);
  if (out.mesh.triangles.empty()) throw InputError(name + " holds no triangle.");
  if (format == SoupFormat::kStl) add_note(out.notes, "STL: corners at equal places joined");
  return out;
}

PolygonSoup read_polygons(const std::filesystem::path& file) {
  return with_sentences(file, [&](const std::string& name) {
    const std::string bytes = text::read_file_bytes(file, "mesh file", text::kLongestMesh);
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
    const std::string bytes = text::read_file_bytes(file, "mesh file", text::kLongestMesh);
    const std::optional<SoupFormat> format = format_of(file);
    return format ? read_mesh_bytes(*format, bytes, name) : read_with_assimp(file);
  });
}

}  // namespace contactcheck::mesh
