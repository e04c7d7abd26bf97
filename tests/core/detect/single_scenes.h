// Scenes with the pairs of triangles that meet among vertices in single precision, as detectors map
// or are fed them.
#pragma once

#include <string>
#include <vector>

#include "tests/core/detect/scenes.h"

namespace contactcheck::test {

/// Per body.
using FloatVertices = std::vector<std::vector<Vec3f>>;

/// Nodes rounded about the local origin, vertices mapped from them in floats (of a body without a
/// lattice, its rounded vertices).
FloatVertices mapped_in_floats(const std::vector<Body>& bodies, const FrameData& data);

/// The frame's vertices rounded about the local origin.
FloatVertices fed_in_floats(const FrameData& data);

/// Every pair of triangles of different bodies that intersects, by brute force; canonical.
std::vector<ElementPair> meeting_pairs(const std::vector<Body>& bodies,
                                       const FloatVertices& vertices);

struct SingleScene {
  std::string name;
  Scene scene;
  bool lattices = true;                          ///< every body has one
  std::vector<std::vector<ElementPair>> mapped;  ///< per frame, of mapped_in_floats()
  std::vector<std::vector<ElementPair>> fed;     ///< per frame, of fed_in_floats()
};

/// With and without lattices, near and far, tiny and large, degenerate; made once.
const std::vector<SingleScene>& single_scenes();

/// That the prepared detector finds these pairs of triangles, per frame, and their bodies.
void expect_pairs(Detector& detector, const SingleScene& single,
                  const std::vector<std::vector<ElementPair>>& expected);

}  // namespace contactcheck::test
