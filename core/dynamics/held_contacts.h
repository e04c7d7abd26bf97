// Contact between two detections. A detector answers once per time step, but the springs of a light
// node swing many times within one: a velocity that was stopped at the detection is back long
// before the next. So the points of the last detection are held through the substeps: their sides
// may separate, and may return to their distance at the detection, but come no nearer.
#pragma once

#include <vector>

#include "core/dynamics/contact_point.h"
#include "core/dynamics/response.h"

namespace contactcheck {

class HeldContacts {
 public:
  /// Replaces the points held so far. `bodies`: the states that the points were found in.
  void hold(std::vector<ContactPoint> points, const std::vector<ResponseBody>& bodies);
  bool empty() const { return points_.empty(); }

  /// Stops the approach at every point whose sides are no farther apart than when it was found, in
  /// order, with Coulomb friction for that impulse. Linear momentum of two movable bodies is
  /// conserved up to rounding; kinetic energy is never gained.
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
