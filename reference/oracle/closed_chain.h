// Whether a surface encloses a volume: its triangles form a closed chain, in one frame.
//
// Vertices at equal coordinates (-0 = 0) are one vertex. The chain is closed if the triangles with
// area run every edge equally often in both directions; then the winding number is an integer off
// the surface. An edge may have any number of triangles. Several components, seams of doubled
// vertices, duplicates and repeated corners are allowed. So are triangles without area (exactly
// collinear corners), free or filling a seam: edges that remain count as closed where they run only
// along edges of such triangles and cancel there, piece by piece. Only comparisons and exact signs
// decide.
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

/// An edge that is not run equally often in both directions, as one triangle names it.
struct OpenEdge {
  std::uint32_t triangle = 0;
  std::uint32_t from = 0, to = 0;  ///< vertices of the triangle, before welding
  bool operator==(const OpenEdge&) const = default;
};

/// "open (edge of vertices 4 and 5)", with the numbers of given vertices; with `where`: "open (body
/// "cube", frame 3, edge of vertices 4 and 5)". All messages use this function.
std::string open_reason(const OpenEdge& edge, const GivenVertices& given,
                        const std::string& where = "");

/// A surface in one frame, its vertices welded.
struct SurfaceChain {
  std::vector<std::uint32_t> welded;     ///< per vertex: the first vertex at its coordinates
  std::vector<std::uint32_t> component;  ///< per triangle, also without area
  /// Per component, one of its vertices, as its first triangle names it. Components are connected
  /// by welded edges and numbered by their first triangles.
  std::vector<std::uint32_t> component_vertex;
  /// The first open edge of the first triangle that has one; none if the chain is closed.
  std::optional<OpenEdge> open;

  bool closed() const { return !open.has_value(); }
};

/// @pre indices in range, vertices finite
SurfaceChain surface_chain(std::span<const Triangle> triangles, std::span<const Vec3> vertices);

/// The same without positions: no vertices are welded and every triangle counts. If this chain is
/// closed, the surface is closed in every frame; its components are parts of the components of
/// every frame. @pre indices in range
SurfaceChain surface_chain_as_written(std::span<const Triangle> triangles, std::size_t vertices);

}  // namespace contactcheck::oracle
