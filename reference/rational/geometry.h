// Slow, exact answers in rational arithmetic (GMP), to judge the fast ones.
//
// Independent on purpose: intersections are linear programs over barycentric coordinates, solved by
// the simplex method with Bland's rule, so that touching, coplanar and degenerate input is no
// special case. Nothing here calls core's predicates. @pre all coordinates finite
#pragma once

#include <gmpxx.h>

#include "core/types/vec3.h"
#include "reference/rational/vectors.h"

namespace contactcheck::rational {

/// The sign that the predicates of core/narrow/predicates.h promise.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

/// True when the closed triangles share a point; degenerate ones are segments or points.
bool triangles_intersect(const TriangleCorners& p, const TriangleCorners& q);

/// True when the closed triangle and the closed box share a point; an empty box shares none.
bool triangle_meets_box(const TriangleCorners& triangle, const Aabb& box);

/// Exact squared distance in square metres; 0 exactly when the closed triangles share a point.
mpq_class squared_distance(const TriangleCorners& p, const TriangleCorners& q);

}  // namespace contactcheck::rational
