// The paper's element test: is a node on the inner side of all six planes of a mapped box?
// Source: Jeon, Hong, Choi, Jeong 2013, "each node against each plane of the boxes in its bucket".
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/types/ordered_dot.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// A mapped box has faces that need not be planar; the paper does not say which planes it means. A
/// face's plane here goes through its centroid, its normal is the cross product of its diagonals,
/// outward at rest. A face without area has normal zero and excludes nothing.
template <typename T>
struct BoxPlanesOf {
  std::array<Vec3Of<T>, 6> normal;
  std::array<Vec3Of<T>, 6> point;
};
using BoxPlanes = BoxPlanesOf<double>;

template <typename T>
BoxPlanesOf<T> planes_of_box(const std::array<Vec3Of<T>, 8>& corners) {
  // Counter-clockwise seen from outside at rest; corner c is high on axis k when bit k is set.
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  BoxPlanesOf<T> planes;
  for (int f = 0; f < 6; ++f) {
    const Vec3Of<T>&a = corners[kFaces[f][0]], &b = corners[kFaces[f][1]],
          &c = corners[kFaces[f][2]], &d = corners[kFaces[f][3]];
    planes.normal[f] = (c - a).cross(d - b);
    planes.point[f] = T(0.25) * ((a + b) + (c + d));
  }
  return planes;
}

/// Closed: a node on a plane counts as inside. An approximation by nature, in plain arithmetic of
/// its precision; the suite measures its false negatives and false positives.
template <typename T>
bool node_inside(const BoxPlanesOf<T>& planes, const std::type_identity_t<Vec3Of<T>>& node) {
  for (int f = 0; f < 6; ++f) {
    const Vec3Of<T> arm = node - planes.point[f];
    if (ordered_dot<T>(planes.normal[f], arm) > 0) return false;
  }
  return true;
}

/// The shortest way out of a box for a node that node_inside() finds inside.
struct NodeDepth {
  double depth = 0.0;           ///< metres to the nearest plane, never negative
  Vec3 outward = Vec3::Zero();  ///< unit normal of that plane; zero: no plane has a normal
};

/// Depth by the same planes, except faces without area: moving the node by depth * outward takes it
/// onto the nearest plane. Exact for parallelepipeds up to rounding; an approximation for other
/// boxes, as their planes are. No verdict depends on it.
/// @pre node_inside(planes, node)
template <typename T>
NodeDepth node_depth(const BoxPlanesOf<T>& planes, const std::type_identity_t<Vec3Of<T>>& node) {
  NodeDepth nearest;
  for (int f = 0; f < 6; ++f) {
    const T largest = planes.normal[f].cwiseAbs().maxCoeff();
    if (!(largest > 0) || largest > std::numeric_limits<T>::max()) continue;
    // Scaled first: squares of a small face's normal underflow.
    const Vec3Of<T> scaled = planes.normal[f] / largest;
    const Vec3Of<T> unit = scaled / std::sqrt(ordered_dot<T>(scaled, scaled));
    const Vec3Of<T> arm = planes.point[f] - node;
    const double depth = std::max<T>(0, ordered_dot<T>(unit, arm));
    if (!nearest.outward.isZero(0.0) && depth >= nearest.depth) continue;
    nearest = {depth, unit.template cast<double>()};
  }
  return nearest;
}

}  // namespace contactcheck
