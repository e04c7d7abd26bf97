// Scenes of bodies that no mesh file of a user looks like and that every exact detector must get
// right: thin, huge and tiny ones, lattices of hundreds of cells along an axis of which few are
// kept, cells far larger than the body, vertices of hundreds of triangles, hundreds of bodies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/shapes.h"

namespace contactcheck::test {

struct OddScene {
  std::string description;  ///< of the bodies and of the frames, for messages
  std::vector<Body> bodies;
  std::vector<FrameData> frames;  ///< at least one; all coordinates finite
};

/// The scene of a seed, the same on every machine.
OddScene odd_scene(std::uint64_t seed);

}  // namespace contactcheck::test
