// Small candidates for the tests of reduction.
#pragma once

#include "reference/reduce/candidate.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// Two divided boxes at places of many digits that press into one another by a third.
inline reduce::CaseCandidate two_boxes(int divisions = 2) {
  const Vec3 corner(0.1, 0.2, 0.3), size(1.0, 1.1, 0.9), shift(0.7, 0.31, 0.17);
  reduce::CaseCandidate out;
  out.names = {"left", "right"};
  out.meshes = {box_mesh(corner, corner + size, divisions),
                box_mesh(corner + shift, corner + shift + size, divisions)};
  return out;
}

/// Two triangles; coordinates x, y, z of the corners after one another.
inline reduce::CaseCandidate two_triangles(const std::vector<double>& coordinates) {
  reduce::CaseCandidate out;
  out.names = {"first", "second"};
  out.meshes.resize(2);
  for (TriangleMesh& mesh : out.meshes) {
    mesh.vertices.resize(3, Vec3::Zero());
    mesh.triangles = {{0, 1, 2}};
  }
  return reduce::with_coordinates(out, coordinates);
}

}  // namespace contactcheck::test
