// Contact between two frames: a vertex and a triangle, or two edges, whose points move straight.
//
// Each point moves from its place at t = 0 to its place at t = 1 at constant speed; the doubles of
// both places are exact numbers. Elements are closed: touching counts, and a degenerate triangle or
// edge is the segment or the point that it is at that time.
#pragma once

#include <array>
#include <cstdint>

#include "core/types/vec3.h"

namespace contactcheck {

enum class ImpactKind : std::uint8_t { vertex_triangle, edge_edge };

/// As in names of files and options: "vertex-face", "edge-edge".
constexpr const char* name_of(ImpactKind kind) {
  return kind == ImpactKind::vertex_triangle ? "vertex-face" : "edge-edge";
}

/// Four moving points, in metres: vertex, then the triangle's corners; or the first edge's ends,
/// then the second edge's.
struct ImpactQuery {
  ImpactKind kind = ImpactKind::vertex_triangle;
  std::array<Vec3, 4> start;  ///< at t = 0
  std::array<Vec3, 4> end;    ///< at t = 1
};

/// The width of the interval of a time of contact is at most this, a fraction of the step.
inline constexpr double kImpactTimeWidth = 0x1p-40;

/// Whether the elements meet at some t in [0, 1], and when first.
struct Impact {
  bool contact = false;
  bool starts_in_contact = false;  ///< in contact at t = 0; then both times are 0
  /// The first time of contact lies in [earliest, latest], of width at most kImpactTimeWidth,
  /// within [0, 1]; both 0 without contact.
  double earliest = 0, latest = 0;
};

/// What a detector calls contact although nothing meets: elements whose smallest distance within
/// the step is at most the larger of the two.
struct ImpactTolerance {
  double absolute = 0;  ///< metres
  double of_start = 0;  ///< times the distance of the elements at t = 0
};

}  // namespace contactcheck
