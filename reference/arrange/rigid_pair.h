// Two rigid bodies, one of which is moved: how far apart are they, do they touch?
#pragma once

#include <vector>

#include "reference/oracle/oracle.h"

namespace contactcheck {

class RigidPair {
 public:
  /// @throws InputError when a mesh has a fatal defect
  RigidPair(const TriangleMesh& resting, const TriangleMesh& moved);

  /// Other vertices of the moved body, from which offsets count. @pre as many as its mesh has
  void turn(std::vector<Vec3> vertices) { turned_ = std::move(vertices); }
  const std::vector<Vec3>& resting() const { return resting_; }
  const std::vector<Vec3>& moved() const { return turned_; }

  /// Certified, with the moved body at this offset: 0 exactly when the surfaces share a point.
  DistanceInterval distance(const Vec3& offset);
  bool touches(const Vec3& offset) { return distance(offset).upper == 0.0; }

 private:
  std::vector<Body> bodies_;
  std::vector<Vec3> resting_, turned_, placed_;
  Oracle oracle_;
};

}  // namespace contactcheck
