// A simulated scene small enough to be simulated many times.
#pragma once

#include <string>

namespace contactcheck::test {

/// Two boxes of 0.5 m in lattices of 2 x 2 x 2 cells (a copy each), that start just above the
/// ground and one another: 12 frames of 2 steps, the later ones in contact.
inline std::string falling_scene(
    const std::string& material =
        R"({"model": "mass-spring", "mass": 5, "stiffness": 600, "damping": 1})") {
  return R"({
  "id": "falling", "title": "Two boxes", "frames": 12,
  "simulation": {"every": 2, "ground": {}},
  "levels": ["body", "cell", "triangle"],
  "bodies": [
    {"name": "box", "copies": {"counts": [1, 2, 1], "spacing": [0, 0.55, 0]},
     "mesh": {"shape": "box", "divisions": 2, "scale": 0.5}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0, 0.3, 0], "spins": [{"axis": "y", "degrees": 20}]},
     "material": )" +
         material + R"(},
    {"name": "wall", "mesh": {"shape": "box", "divisions": 1, "scale": 0.1},
     "lattice": {"cells": [1, 1, 1]}, "motion": {"position": [5, 0, 0]}}]
})";
}

}  // namespace contactcheck::test
