// Contact between two detections. A detector speaks once per time step, but the springs of a light
// node swing many times within one: a velocity that was stopped at the detection is back long
// before the next. So the points of the last detection are held through the substeps: their sides
// may separate, and may come back as far as they were, but no nearer.
#pragma once

#include <vector>

#include "core/dynamics/contact_point.h"
#include "core/dynamics/response.h"

namespace contactcheck {

class HeldContacts {
 public:
  /// Forgets the points held so far. `bodies`: the states that the points were found in.
  void hold(std::vector<ContactPoint> points, const std::vector<ResponseBody>& bodies);
  bool empty() const { return points_.empty(); }

  /// Takes the approach out of every point whose sides are as near as they were, in order, with
  /// Coulomb's friction for what that took. Linear momentum of two movable bodies is conserved up
  /// to rounding; kinetic energy is never gained.
  void stop_approach(std::vector<ResponseBody>& bodies) const;

 private:
  struct Held {
    ContactPoint point;
    double separation = 0.0;    // metres along the normal when it was found
    double inverse_mass = 0.0;  // 1/kg
    double friction = 0.0;
  };

  std::vector<Held> points_;
};

}  // namespace contactcheck
