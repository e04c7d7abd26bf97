#include "reference/arrange/rigid_pair.h"

namespace contactcheck {

RigidPair::RigidPair(const TriangleMesh& resting, const TriangleMesh& moved)
    : bodies_{{"resting", make_bare_shape(resting)}, {"moved", make_bare_shape(moved)}},
      resting_(resting.vertices),
      turned_(moved.vertices),
      oracle_(bodies_) {}

DistanceInterval RigidPair::distance(const Vec3& offset) {
  placed_.clear();
  for (const Vec3& v : turned_) placed_.push_back(v + offset);
  Frame frame;
  frame.bodies = {{resting_, resting_}, {placed_, placed_}};
  return oracle_.distance(frame, {0, 1});
}

}  // namespace contactcheck
