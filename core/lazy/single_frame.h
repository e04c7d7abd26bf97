// The frame of all bodies in single precision: float(x - origin) * scale, with the local origin of
// the scene (core/types/local_origin.h) and the power of two that brings its half-width to at most
// 1. Nodes are rounded once, by the difference; the scale changes no digit of what is not lost
// beside the scene anyway (less than 2^-126 of it). Vertices are mapped from these floats, boxes
// made and triangles tested of them, without a look back at the doubles.
//
// What is found: exactly the pairs of triangles of these floats that intersect. The same on every
// instruction set and number of threads, and whether bounds come from nodes or from vertices.
#pragma once

#include <span>
#include <vector>

#include "core/lazy/lazy_state.h"

namespace contactcheck {

/// Forgets the last frame and rounds `nodes` (vertices, without a lattice) about the origin.
/// @pre shape, tree and from_vertices are set; in single precision
/// @throws RefusedInput when one is farther from the origin than kSingleLimit
void begin_frame_in_single(LazyState& state, std::span<const Vec3> nodes, const Vec3& origin);

/// Takes the rounded nodes into the frame common to all bodies, and finds boxes and slacks. Where
/// from_vertices, `single.vertices` is to be set before blocks are bounded.
/// @pre begin_frame_in_single of each with this origin
void place_in_single(std::span<LazyState> states, const Vec3& origin);

/// The body's vertices in the frame, one by one by map_point() (core/deform): what leaves and
/// refitted bodies are made of, for tests. @pre place_in_single
std::vector<Vec3f> single_vertices(const LazyState& state);

}  // namespace contactcheck
