// What a simulated body is made of. SI units.
#pragma once

#include <cstdint>

namespace contactcheck {

/// How the lattice nodes of a body answer forces; see the header of each model.
enum class DeformableModel { kMassSpring, kFiniteElements, kShapeMatching };

struct Material {
  DeformableModel model = DeformableModel::kMassSpring;
  double mass = 1.0;  ///< kg, the whole body; above 0

  /// Mass-spring: every spring, whatever its length. Stiffness N/m, damping N s/m along the spring.
  double stiffness = 1000.0, damping = 0.2;

  /// Finite elements: Pa; Poisson's ratio in [0, 0.5); seconds by which the elastic force looks
  /// ahead (Rayleigh damping proportional to stiffness).
  double youngs_modulus = 1e5, poisson_ratio = 0.3, damping_time = 0.002;

  /// Shape matching: the time constant, seconds, with which a node goes to its goal; half-width of
  /// a region, cells (0: the whole body is one region).
  double relaxation_time = 0.02;
  std::uint32_t region = 1;

  /// Contact: share of the approach velocity that is given back, and Coulomb's coefficient. Two
  /// bodies in contact use the larger restitution and the geometric mean of their frictions.
  double restitution = 0.2, friction = 0.4;
};

}  // namespace contactcheck
