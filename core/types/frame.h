// One frame of a scene, and one step: the input of every detector.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// The deformed state of one body. `nodes` are the lattice nodes (of the kept cells, in the
/// lattice's node order) or, for a body without a lattice, its vertices. `vertices` are the mapped
/// vertices, or empty for a detector that does not need them (Detector::needs_vertices). Metres.
struct BodyState {
  std::span<const Vec3> nodes;
  std::span<const Vec3> vertices;
};

/// All values are finite: the runner refuses NaN and infinity before any detector sees them.
struct Frame {
  std::size_t index = 0;
  double time = 0.0;  ///< seconds
  std::vector<BodyState> bodies;
};

/// The motion from a frame of a scene to the next. Every vertex moves straight, at constant speed,
/// from its place at t = 0, which is `start`, to that at t = 1: t is a fraction of the step. In
/// between, vertices are not those of the nodes in between: mapping rounds at both ends.
struct Step {
  Frame start, end;
  /// Nodes and vertices at the start are, bit for bit, those at the end of the step that the same
  /// detector was given before: what it computed of them holds. False where that is not certain.
  bool follows = false;
  std::size_t index() const { return start.index; }
};

}  // namespace contactcheck
