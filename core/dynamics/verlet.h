// Stoermer-Verlet steps, the integrator of the models with forces.
//
// Drift, kick, drift: half a step along the velocity, one kick by the forces there, half a step
// along the new velocity. It is the twin of kick-drift-kick with the same accuracy (second order),
// the same limit of stability and free fall exact up to rounding, but asks for the forces once:
// kick-drift-kick would ask twice, because nothing may be kept from one step to the next (contact
// moves nodes in between).
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/dynamics/deformable.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Share of the longest stable step at rest that is taken. Stability asks for the square root of
/// the stiffness, so that 3/4 leaves room for strain to raise the stiffness by 7/9.
inline constexpr double kStrainMargin = 0.75;

/// Seconds: the longest stable step of x'' = -stiffness * x - damping * x' (1/s^2, 1/s); infinity
/// when both are zero. The step's matrix has trace 2 - c h - w^2 h^2 and determinant 1 - c h, so
/// both eigenvalues stay within the unit circle as long as w^2 h^2 + 2 c h <= 4. Bounds of the two
/// that rise and fall together over all modes of a body give a bound for the body.
inline double longest_verlet_step(double stiffness, double damping) {
  return 4.0 / (damping + std::sqrt(damping * damping + 4.0 * stiffness));
}

/// One step of dt seconds. `add_forces(positions, velocities, forces)` adds newtons to the given
/// zeros. Allocates only when a thread steps more nodes than ever before.
template <typename AddForces>
void verlet_step(double dt, const Vec3& acceleration, std::span<const double> masses,
                 NodeState& state, AddForces&& add_forces) {
  thread_local std::vector<Vec3> forces;
  forces.assign(masses.size(), Vec3::Zero());
  for (std::size_t n = 0; n < masses.size(); ++n)
    state.positions[n] += state.velocities[n] * (0.5 * dt);
  add_forces(std::span<const Vec3>(state.positions), std::span<const Vec3>(state.velocities),
             std::span<Vec3>(forces));
  for (std::size_t n = 0; n < masses.size(); ++n) {
    state.velocities[n] += (acceleration + forces[n] / masses[n]) * dt;
    state.positions[n] += state.velocities[n] * (0.5 * dt);
  }
}

}  // namespace contactcheck
