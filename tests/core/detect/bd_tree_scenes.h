// Deformed bodies for the tests of the detector bd-tree.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "tests/core/detect/scenes.h"

namespace contactcheck::test {

using Deform = std::function<Vec3(const Vec3&)>;

inline std::vector<Vec3> moved(const BodyShape& shape, const Deform& deform) {
  std::vector<Vec3> nodes = rest_nodes_at(shape, Vec3::Zero());
  for (Vec3& n : nodes) n = deform(n);
  return nodes;
}

inline Vec3 turned(const Vec3& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
}
inline Vec3 twisted(const Vec3& p) { return turned(p, 1.2 * p.z()); }
inline Vec3 bent(const Vec3& p) {
  return {p.x() * std::cos(p.z()), p.y(), p.z() + 0.5 * p.x() * p.x()};
}

/// Two instances of one shape, turned and apart by `gap` (touching near 2), one frame per gap.
inline Scene deformed_pair(const Deform& first, const Deform& second,
                           const std::vector<double>& gaps, int levels = 3) {
  Scene scene;
  const auto shape = make_body("", sphere_mesh(Vec3::Zero(), 1.0, levels), {4, 4, 5}).shape;
  scene.bodies = {{"left", shape}, {"right", shape}};
  for (double gap : gaps) {
    const Vec3 at(7.0, -3.0, 2.0), step(gap, 0.1, 0.05);
    scene.frames.push_back(make_frame(
        scene.bodies,
        {moved(*shape, [&](const Vec3& p) -> Vec3 { return turned(first(p), 0.7) + at; }),
         moved(*shape,
               [&](const Vec3& p) -> Vec3 { return turned(second(p), -2.0) + at + step; })}));
  }
  return scene;
}

}  // namespace contactcheck::test
