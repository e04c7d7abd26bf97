// How much, how far, how deep: the graded truth beside the verdicts, for the deformed doubles of a
// frame. Doubles of stated accuracy, degenerate triangles included, at every scale; whether two
// pieces touch at all is decided exactly, as by the oracle.
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

/// The shortest translations that separate two pieces, or take a vertex to a surface. "As short":
/// within 1e-9 of the body size, the largest side of the boxes of the two bodies' vertices.
struct Penetration {
  double depth = 0.0;            ///< metres
  std::vector<Vec3> directions;  ///< unit; all as short, nearly equal ones (1e-9) given once
};

/// How deep two bodies are in each other (surface_depth.h).
struct SurfaceDepth {
  double lower = 0.0, upper = 0.0;  ///< metres; lower <= depth <= upper
  /// Set where the depth is unknown, because a body is not a simple solid.
  struct Unknown {
    std::uint32_t body = 0;
    SolidFault fault;
  };
  std::optional<Unknown> unknown;
};

/// Trees and hulls are fitted when a question first needs them: an object serves one thread.
class SurfaceGeometry {
 public:
  explicit SurfaceGeometry(const std::vector<Body>& bodies);
  ~SurfaceGeometry();
  SurfaceGeometry(const SurfaceGeometry&) = delete;
  SurfaceGeometry& operator=(const SurfaceGeometry&) = delete;

  /// The frame that the questions below are about; its spans must outlive them. Every question is
  /// about bodies and elements of the scene.
  /// @pre frame has vertices for every body (nodes too for box_penetration), all finite
  void set_frame(const Frame& frame);

  /// Metres: the diameter of the intersection of two closed triangles, which for two that cross is
  /// the length of the segment they share; 0 where they share one point or none.
  /// Off by less than 1e-9 of the larger triangle's largest side, whatever their position.
  double intersection_length(const ElementPair& triangles) const;
  /// Metres: the distance of two triangles, the upper end of a certified interval of at most 1e-9
  /// of it (2e-154 of the coordinates below 1e-150 of them); 0 exactly when they share a point.
  double triangle_distance(const ElementPair& triangles) const;
  /// Metres: the distance of a vertex to the surface of another body (`where.in`), off by less than
  /// 1e-12 of the body size or of itself, with the directions from the vertex to its nearest points
  /// there; no directions when it lies on it.
  Penetration vertex_to_surface(const VertexInBody& where) const;
  /// The surface depth of two bodies, or the first body of the two that is not a simple solid (told
  /// once a frame). Both ends are 0 only where no point of either surface is inside the other body.
  /// The interval is at most a thousandth of its upper end wide, or 1e-9 of the largest
  /// |coordinate|, unless the search ends first (kMostDepthPieces); one that lies below `limit`, in
  /// metres, may be as wide as it is, and one that holds it is narrowed to the latter.
  SurfaceDepth surface_depth(BodyPair pair,
                             double limit = -std::numeric_limits<double>::infinity());
  /// The shortest translation of piece b that leaves the two at most touching, by brute force over
  /// all face normals and products of edges, off by less than 1e-12 of the pieces' joint size;
  /// nothing when they are disjoint. Flat pieces in one plane have depth 0 along its normals; on
  /// one line, where all directions across it are as short, four of them are given.
  std::optional<Penetration> triangle_penetration(const ElementPair& triangles) const;
  /// The same for the mapped FFD-AABB boxes (convex hulls of 8 nodes) of two kept cells.
  std::optional<Penetration> box_penetration(const ElementPair& cells);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::oracle
