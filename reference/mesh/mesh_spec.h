// A body's mesh in a scene file, and building it.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "reference/mesh/mesh_file.h"
#include "reference/text/json_field.h"

namespace contactcheck::mesh {

/// The "mesh" of a body, all defaults filled in. Equal specs give equal meshes, so bodies with
/// equal specs share one shape.
struct MeshSpec {
  enum class Source { kDataset, kFile, kShape };

  Source source = Source::kShape;
  std::string name;                      ///< dataset, resolved path of the file, or shape
  std::size_t divisions = 0;             ///< shapes only
  std::array<double, 3> sides = {};      ///< box only, metres
  double tube = 0.0;                     ///< torus only
  char letter = '\0';                    ///< letters only
  double depth = 0.0;                    ///< letters only
  bool seams = false;                    ///< teapot only: patches share no vertex
  double length = 0.0;                   ///< sheet only, along z, metres
  std::optional<std::size_t> triangles;  ///< simplify to this many
  std::size_t subdivide = 0;             ///< times that every triangle is split into four
  std::optional<double> size;            ///< scale so that the largest side has this length, metres
  std::optional<double> scale;           ///< or multiply all coordinates by this
  std::optional<std::array<double, 3>> center;  ///< then move the box's centre here
  Folded folded = Folded::kLeftOut;             ///< files only: "repair"
  bool weld = false;  ///< self-contact treats vertices at one place as one vertex

  bool operator==(const MeshSpec&) const = default;
};

/// `folder`: the base of relative "file" paths.
MeshSpec parse_mesh_spec(const text::JsonField& field, const std::filesystem::path& folder);

/// Loads, simplifies, scales and moves. `field` is named in the error if the mesh does not fit the
/// spec (simplifying to more triangles than there are).
/// @throws InputError
LoadedMesh build_mesh(const MeshSpec& spec, const text::JsonField& field);

/// One line for the results: "libcgal-demo:bunny00.off, simplified to 5914 triangles".
std::string described_source(const MeshSpec& spec);

}  // namespace contactcheck::mesh
