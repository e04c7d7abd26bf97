#include "reference/adapters/bullet.h"

#include <LinearMath/btScalar.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactcheck::adapters {

std::string bullet_version() {
  const int version = btGetVersion();
  return std::to_string(version / 100) + "." + std::to_string(version % 100) +
         (sizeof(btScalar) == sizeof(float) ? " float" : " double");
}

double smallest_doubled_area(const TriangleMesh& mesh) {
  std::vector<double> doubled_areas;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 u = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Vec3 v = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const double doubled_area = u.cross(v).stableNorm();
    if (doubled_area > 0.0) doubled_areas.push_back(doubled_area);
  }
  if (doubled_areas.empty()) return std::numeric_limits<double>::infinity();
  std::sort(doubled_areas.begin(), doubled_areas.end());
  const double sliver = 1e-6 * doubled_areas[doubled_areas.size() / 2];
  return *std::lower_bound(doubled_areas.begin(), doubled_areas.end(), sliver);
}

double automatic_bullet_scale(const std::vector<Body>& bodies) {
  const double needed = 8.0 * std::sqrt(1.1920929e-7);  // |cross| in square world units
  const double limit = 1048576.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body& body : bodies)
    smallest = std::min(smallest, smallest_doubled_area(body.shape->mesh));
  double scale = 1.0;
  while (scale < limit && !(scale * scale * smallest >= needed)) scale *= 2.0;
  return scale;
}

}  // namespace contactcheck::adapters
