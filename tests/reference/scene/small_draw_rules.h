// Rules of drawn scenes that are small enough for tests.
#pragma once

#include <string>
#include <utility>

namespace contactcheck::test {

inline std::string small_draw_rules(
    const std::string& shares =
        R"("apart": 4, "near-miss": 4, "graze": 2, "touch": 3, "deep": 3, "pile": 2, "nested": 2)") {
  return R"({
  "id": "small",
  "detectors": ["full-refit"],
  "meshes": ["box", "letter", "sphere", "torus"],
  "shares": {)" +
         shares + R"(},
  "most_triangles": 4000,
  "triangles": [80, 600],
  "cells": [8, 60],
  "bodies": [2, 4],
  "size_ratio": [1, 4],
  "frames": [6, 10],
  "speed": [0, 0.05],
  "contact_share": [0.34, 1],
  "deformers": [0, 2],
  "twist": [-60, 60],
  "bend": [-60, 60],
  "taper": [-0.3, 0.3],
  "stretch": [-0.25, 0.4],
  "apart_gap": [0.1, 1],
  "near_gap": [1e-5, 0.01],
  "graze_depth": [1e-6, 0.0001],
  "touch_depth": [0.001, 0.02],
  "deep_depth": [0.03, 0.2]
})";
}

/// Of scenes that are judged between frames.
inline std::string small_step_rules(const std::string& shares, const std::string& self = "0.5") {
  std::string text = small_draw_rules(shares);
  for (const auto& [from, to] :
       {std::pair("[6, 10]", "[2, 4]"), std::pair("[0, 0.05]", "[0.001, 1]")})
    text.replace(text.find(from), std::string(from).size(), to);
  text.replace(text.rfind('}'), 1,
               ", \"steps\": {\"most_swept\": 300, \"self_share\": " + self +
                   ", \"self_twist\": [10, 270]}}");
  return text;
}

}  // namespace contactcheck::test
