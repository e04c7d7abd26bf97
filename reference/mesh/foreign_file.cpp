#include "reference/mesh/foreign_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <array>
#include <assimp/Importer.hpp>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"

namespace contactcheck::mesh {
namespace {

constexpr const char* kFormats =
    "formats that are read: .obj, .off, .ply and .stl in doubles; .3ds, .dae, .fbx, .glb, .gltf, "
    ".x3d and others by assimp, in floats";

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

}  // namespace

LoadedMesh read_foreign_file(const std::filesystem::path& file, const std::string& name) {
  Assimp::Importer importer;
  auto* const files = new InputFiles;  // the importer owns it
  importer.SetIOHandler(files);
  const std::string extension = file.extension().string();
  if (!importer.IsExtensionSupported(extension))
    throw InputError(name + " cannot be read: " +
                     (extension.empty()
                          ? "it has no extension"
                          : text::in_quotes(extension) + " is no format that is read") +
                     "; " + kFormats + ".");
  // What is animated is gone once transforms are applied.
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  const unsigned animations = scene == nullptr ? 0 : scene->mNumAnimations;
  if (scene != nullptr)
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    std::string reason = files->refused.empty() ? importer.GetErrorString() : files->refused;
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) reason.pop_back();
    throw InputError(name + " cannot be read by assimp: " + reason + "; " + kFormats + ".");
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
  if (animations > 0)
    add_note(out.notes, text::counted(animations, "animation") + " left out: the mesh is at rest");
  return out;
}

}  // namespace contactcheck::mesh
