// A scene small enough to be run many times.
#pragma once

#include <string>

namespace contactcheck::test {

/// Two boxes in lattices of 3 x 3 x 3 cells: one comes, sinks in and leaves again.
inline std::string tiny_scene(const std::string& id = "tiny", const std::string& frames = "5") {
  return R"({
  "id": ")" +
         id + R"(", "title": "Two boxes", "frames": )" + frames + R"(, "duration": 1,
  "levels": ["body", "containment", "cell", "box", "triangle", "vertex"],
  "bodies": [
    {"name": "left", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [3, 3, 3]}},
    {"name": "right", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [3, 3, 3]},
     "motion": {"position": [[0, [1.3, 0.1, 0.2]], [0.5, [0.9, 0.1, 0.2]], [1, [1.3, 0.1, 0.2]]],
                "deformers": [{"twist": {"axis": "x", "degrees": [[0, 0], [1, 20]]}}]}}]
})";
}

}  // namespace contactcheck::test
