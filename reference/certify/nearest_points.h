// The nearest points of two closed triangles, exactly. For the .cpp files of this layer alone.
#pragma once

#include "reference/rational/vectors.h"

namespace contactcheck::certify {

using RationalPoint = rational::Point;
using RationalTriangle = rational::PointTriple;
using rational::cross;
using rational::dot;
using rational::operator-;
using rational::to_rational;

/// A point of a triangle: the sum of its corners times the weights, which are not negative and add
/// up to 1.
struct TrianglePoint {
  RationalPoint at;
  std::array<mpq_class, 3> weights;
};

/// The same point twice exactly when the triangles share one.
struct NearestPoints {
  TrianglePoint on_p, on_q;
  mpq_class squared_distance;
};

/// Degenerate triangles are the segment or the point that they are. @pre all coordinates finite
NearestPoints nearest_points(const RationalTriangle& p, const RationalTriangle& q);

}  // namespace contactcheck::certify
