// Does a surface enclose anything? Whether its triangles form a closed chain, in one frame.
//
// Vertices at equal coordinates (-0 = 0) are one. The chain is closed when the triangles of
// positive area run every edge equally often in both directions: then the winding number is whole
// off the surface. Any number of triangles may share an edge; several components, seams of doubled
// vertices, duplicates and repeated corners do not hinder. Triangles of no area (exactly collinear
// corners) do not either, whether they stick out or fill a seam: what is left of the edges counts
// as closed where it runs along edges of such triangles only, and there cancels piece by piece.
// Only comparisons and exact signs decide.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/given_vertices.h"
#include "core/types/mesh.h"
#include "core/types/vec3.h"

namespace contactcheck::oracle {

/// An edge that is not run equally often in both directions, as a triangle names it.
struct OpenEdge {
  std::uint32_t triangle = 0;
  std::uint32_t from = 0, to = 0;  ///< vertices of the triangle, not welded ones
  bool operator==(const OpenEdge&) const = default;
};

/// "open (edge of vertices 4 and 5)", with the numbers of given vertices; with `where`, "open (body
/// "cube", frame 3, edge of vertices 4 and 5)". The one form of this reason.
std::string open_reason(const OpenEdge& edge, const GivenVertices& given,
                        const std::string& where = "");

/// A surface in one frame, its vertices welded.
struct SurfaceChain {
  std::vector<std::uint32_t> welded;     ///< per vertex: the first vertex at its coordinates
  std::vector<std::uint32_t> component;  ///< per triangle, those of no area included
  /// Per component, one of its vertices, as its first triangle names it. A component is what hangs
  /// together by welded edges; they are numbered by their first triangles.
  std::vector<std::uint32_t> component_vertex;
  /// The first triangle's first edge that is open; none: the chain is closed.
  std::optional<OpenEdge> open;

  bool closed() const { return !open.has_value(); }
};

/// @pre indices in range, vertices finite
SurfaceChain surface_chain(std::span<const Triangle> triangles, std::span<const Vec3> vertices);

/// The same without positions: every vertex is itself, and every triangle counts. Where this is
/// closed the surface is closed in every frame; its components are those of every frame, or parts
/// of them. @pre indices in range
SurfaceChain surface_chain_as_written(std::span<const Triangle> triangles, std::size_t vertices);

}  // namespace contactcheck::oracle
