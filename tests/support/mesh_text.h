// Meshes as the text of files, every double to the bit.
#pragma once

#include <charconv>
#include <string>

#include "core/types/mesh.h"

namespace contactcheck::test {

inline std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

inline std::string obj_text(const TriangleMesh& mesh) {
  std::string out;
  for (const Vec3& v : mesh.vertices)
    out += "v " + shortest(v.x()) + " " + shortest(v.y()) + " " + shortest(v.z()) + "\n";
  for (const Triangle& t : mesh.triangles)
    out += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
           std::to_string(t[2] + 1) + "\n";
  return out;
}

}  // namespace contactcheck::test
