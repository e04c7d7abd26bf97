// The moments of a scene that relations are checked in.
#pragma once

#include <cstddef>
#include <vector>

#include "reference/scene/scene.h"
#include "tests/metamorphic/subject.h"

namespace contactcheck::test {

/// The first frame, the first with contact, the one with most pairs of triangles and the last,
/// ascending; fewer where these are the same. @pre the scene is not simulated
Subject telling_moments(const scene::Scene& scene);

}  // namespace contactcheck::test
