// How one body comes to another that rests, so that they really meet: along an axis, from where a
// plane separates them, until their surfaces cross.
#pragma once

#include <optional>
#include <vector>

#include "core/types/mesh.h"
#include "reference/oracle/oracle.h"

namespace contactcheck::scene {

/// Two rigid bodies, one of which is moved: their distance, and whether they touch.
class RigidPair {
 public:
  /// @pre a triangle uses each vertex
  /// @throws InputError when a mesh has a fatal defect
  RigidPair(const TriangleMesh& resting, const TriangleMesh& moved);

  /// Other vertices of the moved body, from which offsets count. @pre as many as its mesh has
  void turn(std::vector<Vec3> vertices) { turned_ = std::move(vertices); }
  const std::vector<Vec3>& resting() const { return resting_; }
  const std::vector<Vec3>& moved() const { return turned_; }

  /// Certified, with the moved body at this offset: 0 exactly when the surfaces share a point.
  oracle::DistanceInterval distance(const Vec3& offset);
  bool touches(const Vec3& offset) { return distance(offset).upper == 0.0; }

 private:
  std::vector<Body> bodies_;
  std::vector<Vec3> resting_, turned_, placed_;
  oracle::Oracle oracle_;
};

/// One of the six directions of the axes.
struct AxisDirection {
  int axis = 0;
  double sign = 1.0;
  Vec3 vector() const { return sign * Vec3::Unit(axis); }
  bool operator==(const AxisDirection&) const = default;
};

/// Places are of the centre of the moved body's box, metres; the other's is the origin.
struct Approach {
  AxisDirection from;               ///< seen from the resting body
  std::optional<int> turned_about;  ///< the moved body is turned by 90 degrees about this axis
  Vec3 separated = Vec3::Zero();    ///< from here on, a plane across `from` separates the two
  Vec3 meeting = Vec3::Zero();      ///< `depth` beyond the place where the surfaces first touch
  double depth = 0.0;               ///< metres along `from`, above 0
  /// Moved a little to any side, the surfaces still meet: no question of rounding.
  bool robust = false;
};

/// The first that is robust among the directions, aims (box centre at box centre, foremost point at
/// foremost point) and turns, with the largest depth that one allows: 8 % of the smaller
/// body's largest side, or 2 %, 0.5 %, 0.125 %. One that is not robust where no other is found, and
/// nothing where the surfaces do not meet over any of these depths.
/// @pre the centre of each mesh's box is the origin, and no box is a point; a triangle uses each
/// vertex; at least one direction
/// @throws InputError when a mesh has a fatal defect
std::optional<Approach> find_approach(const TriangleMesh& resting, const TriangleMesh& moved,
                                      const std::vector<AxisDirection>& directions);

}  // namespace contactcheck::scene
