// The graded truth: lengths, distances and depths for the deformed doubles of a frame. They are
// doubles of stated accuracy, degenerate triangles included, at every scale. Whether two pieces
// touch is decided exactly, as by the oracle.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "reference/oracle/simple_solid.h"

namespace contactcheck::oracle {

/// The shortest translations that separate two pieces, or move a vertex to a surface. "Shortest" is
/// within 1e-9 of the body size, the largest side of the boxes of the two bodies' vertices.
struct Penetration {
  double depth = 0.0;            ///< metres
  std::vector<Vec3> directions;  ///< unit; nearly equal ones (1e-9) are given once
};

/// How deep two bodies penetrate each other (surface_depth.h).
struct SurfaceDepth {
  double lower = 0.0, upper = 0.0;  ///< metres; lower <= depth <= upper
  /// Set if the depth is undefined, because a body is not a simple solid.
  struct Unknown {
    std::uint32_t body = 0;
    SolidFault fault;
  };
  std::optional<Unknown> unknown;
};

/// Trees and hulls are fitted on first use: an object serves one thread.
class SurfaceGeometry {
 public:
  explicit SurfaceGeometry(const std::vector<Body>& bodies);
  ~SurfaceGeometry();
  SurfaceGeometry(const SurfaceGeometry&) = delete;
  SurfaceGeometry& operator=(const SurfaceGeometry&) = delete;

  /// Sets the frame for the queries below; its spans must outlive them. All arguments of queries
  /// are bodies and elements of the scene.
  /// @pre frame has vertices for every body (nodes too for box_penetration), all finite
  void set_frame(const Frame& frame);

  /// Metres: the diameter of the intersection of two closed triangles: the length of the shared
  /// segment if they cross, 0 if they share one point or none. Off by less than 1e-9 of the larger
  /// triangle's largest side, wherever they are.
  double intersection_length(const ElementPair& triangles) const;
  /// Metres: the distance of two triangles, the upper end of a certified interval of at most 1e-9
  /// of it (2e-154 of the coordinates below 1e-150 of them); 0 exactly when they share a point.
  double triangle_distance(const ElementPair& triangles) const;
  /// Metres: the distance of a vertex to the surface of another body (`where.in`), off by less than
  /// 1e-12 of the body size or of itself, with the directions from the vertex to its nearest points
  /// there; no directions if it lies on the surface.
  Penetration vertex_to_surface(const VertexInBody& where) const;
  /// The surface depth of two bodies, or the first of them that is not a simple solid (checked once
  /// a frame). Both ends are 0 only if no point of either surface is inside the other body. The
  /// interval is at most a thousandth of its upper end wide, or 1e-9 of the largest |coordinate|,
  /// unless the search ends first (kMostDepthPieces). Below `limit`, in metres, it may have any
  /// width; if it contains `limit`, it is narrowed to the latter.
  SurfaceDepth surface_depth(BodyPair pair,
                             double limit = -std::numeric_limits<double>::infinity());
  /// The shortest translation of piece b that leaves the two at most touching, by brute force over
  /// all face normals and products of edges, off by less than 1e-12 of the pieces' joint size;
  /// nothing if they are disjoint. Flat pieces in one plane have depth 0 along its normals; pieces
  /// on one line get four of the infinitely many directions across it.
  std::optional<Penetration> triangle_penetration(const ElementPair& triangles) const;
  /// The same for the mapped FFD-AABB boxes (convex hulls of 8 nodes) of two kept cells.
  std::optional<Penetration> box_penetration(const ElementPair& cells);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::oracle
