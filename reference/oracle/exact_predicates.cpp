#include "reference/oracle/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>

namespace contactcheck::oracle {
namespace {

using FilteredKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

FilteredKernel::Point_3 to_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

FilteredKernel::Point_2 project(const Vec3& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

FilteredKernel::Triangle_3 to_triangle(const TriangleCorners& t) {
  return {to_point(t[0]), to_point(t[1]), to_point(t[2])};
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return static_cast<int>(CGAL::orientation(to_point(a), to_point(b), to_point(c), to_point(d)));
}

int projected_orientation(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  return static_cast<int>(CGAL::orientation(project(a, axis), project(b, axis), project(c, axis)));
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis)
    if (projected_orientation(a, b, c, axis) != 0) return false;
  return true;
}

bool lexicographically_less(const Vec3& a, const Vec3& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

bool proper_triangles_intersect(const TriangleCorners& p, const TriangleCorners& q) {
  return CGAL::do_intersect(to_triangle(p), to_triangle(q));
}

}  // namespace contactcheck::oracle
