// The path on which one body approaches another that rests: along an axis, from where a plane
// separates them until their surfaces cross.
#pragma once

#include <optional>
#include <vector>

#include "core/types/mesh.h"
#include "reference/oracle/oracle.h"

namespace contactcheck::scene {

/// Two rigid bodies, the second of which is moved: their distance, and whether they touch.
class RigidPair {
 public:
  /// @pre a triangle uses each vertex
  /// @throws InputError when a mesh has a fatal defect
  RigidPair(const TriangleMesh& resting, const TriangleMesh& moved);

  /// Replaces the vertices of the moved body; offsets count from them. @pre as many as its mesh has
  void turn(std::vector<Vec3> vertices) { turned_ = std::move(vertices); }
  const std::vector<Vec3>& resting() const { return resting_; }
  const std::vector<Vec3>& moved() const { return turned_; }

  /// The certified distance, metres, with the moved body at `offset`; exactly 0 if they touch.
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

/// Positions, metres, are of the centre of the moved body's box; the other centre is the origin.
struct Approach {
  AxisDirection from;               ///< direction seen from the resting body
  std::optional<int> turned_about;  ///< the moved body is turned by 90 degrees about this axis
  Vec3 separated = Vec3::Zero();    ///< the plane across `from` separates the two from here on
  Vec3 meeting = Vec3::Zero();      ///< `depth` beyond the place where the surfaces first touch
  double depth = 0.0;               ///< metres along `from`, above 0
  /// The surfaces still meet if the body moves a little sideways, so rounding does not decide.
  bool robust = false;
};

/// Returns the first robust approach over all directions, aims (box centre to box centre, foremost
/// point to foremost point) and turns, at the largest depth that has one: 8 %, 2 %, 0.5 % or 0.125
/// % of the smaller body's largest side. Without a robust one returns another; nothing if the
/// surfaces meet at none of these depths.
/// @pre the centre of each mesh's box is the origin; no box is a point; each vertex is used by a
/// triangle; at least one direction
/// @throws InputError when a mesh has a fatal defect
std::optional<Approach> find_approach(const TriangleMesh& resting, const TriangleMesh& moved,
                                      const std::vector<AxisDirection>& directions);

}  // namespace contactcheck::scene
