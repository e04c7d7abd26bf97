// Tests spheres against spheres, level by level.
#pragma once

#include <cstdint>
#include <vector>

#include "core/detect/ffd_state.h"
#include "core/types/contact_set.h"

namespace contactcheck {

/// Two colliding spheres of one level; without sphere levels a = b = 0 stand for whole bodies.
struct SpherePair {
  BodyPair bodies;
  std::uint32_t a = 0, b = 0;
};

/// What is left after the sphere levels.
struct SphereSurvivors {
  std::size_t bodies = 0;
  std::vector<BodyPair> body_pairs;  ///< candidates, canonical order
  std::vector<char> pair_active;  ///< [a * bodies + b], both orders; [a, a] for a body with itself
  /// Per body: which spheres of the finest level tested are in `sphere_pairs`. Without sphere
  /// levels, one entry for the whole body.
  std::vector<std::vector<char>> sphere_active;
  std::vector<SpherePair> sphere_pairs;  ///< on the finest level tested
  std::vector<SpherePair> parent_pairs;  ///< on the level before it
  std::uint64_t tested = 0;              ///< sphere pairs looked at on the finest level

  bool active(std::uint32_t a, std::uint32_t b) const { return pair_active[a * bodies + b] != 0; }
};

/// Tests sphere levels 1 .. `levels` (0: every pair of bodies is a candidate). `own`: tests every
/// body with itself instead of pairs of two; a sphere collides with itself.
template <typename T>
void run_spheres(const FfdModels<T>& models, const FfdStates<T>& states, BoundsReading bounds,
                 int levels, bool own, SphereSurvivors& out);

}  // namespace contactcheck
