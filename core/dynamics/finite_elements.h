// Corotated linear finite elements: one trilinear hexahedron per kept cell.
// Sources: Mueller & Gross, Interactive Virtual Materials, 2004 (a rotation per element);
// Chao, Pinkall, Sanan, Schroeder, A Simple Geometric Model for Elastic Deformations, 2010 (the
// force as the whole gradient of the corotated energy).
//
// Each element turns back by the rotation R of its mean deformation gradient and answers what is
// left, u = R^T x - X, by its stiffness K: energy u^T K u / 2. The force is the gradient of that
// energy, together with the term by which R follows x, which the well-known R K (R^T x - X) leaves
// out: so energy and angular momentum are kept. Damping answers the rate of u in the same way: it
// takes nothing from a body that moves as a rigid one, whatever its strain.
//
// An inverted element keeps its best proper rotation and is driven back; where the rotation turns
// faster than `kMostSpin` times the strain (nearly flat in two directions, or mirrored), the term
// by which R follows is left out, and energy and angular momentum are no longer kept exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/deformable.h"
#include "core/dynamics/fixed_order.h"
#include "core/types/vec3.h"

namespace contactcheck {

// The stiffness of one box-shaped finite element of isotropic linear material.
// Sources: Wilson, Taylor, Doherty, Ghaboussi, Incompatible Displacement Models, 1973; Taylor,
// Beresford, Wilson, A Non-conforming Element for Stress Analysis, 1976.

/// A symmetric matrix over three displacements of each of the 8 corners: entry (i, k) at
/// [24 * i + k], corner c's displacements at 3 c, 3 c + 1, 3 c + 2. N/m.
using HexahedronStiffness = std::array<double, std::size_t{24} * 24>;

/// Trilinear displacements and, to bend without locking, one inner parabola per axis and direction
/// ("incompatible modes"), which no neighbour sees and which are eliminated here. Their correction
/// of 1976 is the identity for a box, so that every uniform strain is exact.
/// @pre sides and Young's modulus above 0, Poisson's ratio in [0, 0.5)
HexahedronStiffness hexahedron_stiffness(const Vec3& sides, double youngs_modulus,
                                         double poisson_ratio);

/// Never below the largest eigenvalue, and at most 2.6 % above it.
double largest_eigenvalue_bound(const HexahedronStiffness& stiffness);

/// Gradient of a corner's trilinear shape function in the middle of the element, 1/m.
Vec3 corner_gradient(int corner, const Vec3& sides);

class FiniteElements final : public Deformable {
 public:
  /// @pre mass and Young's modulus above 0, Poisson's ratio in [0, 0.5), damping time not negative
  FiniteElements(const Lattice& lattice, const Material& material);

  std::span<const double> masses() const override { return masses_; }
  void step(double dt, const Vec3& acceleration, NodeState& state) const override;
  double stable_step() const override { return stable_step_; }
  double elastic_energy(std::span<const Vec3> positions) const override;

  /// Adds the elastic and the damping force of every element, newtons.
  void add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                  std::span<Vec3> forces) const;

 private:
  struct Element {
    CornerIds nodes;
    std::uint32_t kind = 0;  // into kinds_
  };
  // What all cells of the same sides share: a regular lattice has one kind.
  struct Kind {
    Vec3 sides;
    Corners rest, gradients;  // from corner 0; of the shape functions, in the middle
    HexahedronStiffness stiffness;
  };
  // An element in its current state, relative to its corner 0 and turned back.
  struct Pose {
    Mat3 rotation;
    Corners corners;
    Mat3 spin;  // from the curl of a change of the corners to the turn of the rotation
  };
  using Displacements = std::array<double, 24>;

  std::uint32_t kind_of(const Vec3& sides, const Material& material);
  double longest_step(const Lattice& lattice, const Material& material) const;
  Pose pose_of(const Element& element, std::span<const Vec3> positions) const;
  Displacements strained(const Element& element, const Pose& pose) const;
  void add_rates(const Element& element, const Pose& pose, std::span<const Vec3> velocities,
                 Displacements& u) const;
  static Corners answer(const HexahedronStiffness& stiffness, const Displacements& u);

  double damping_time_;
  std::vector<double> masses_;
  std::vector<Kind> kinds_;
  std::vector<Element> elements_;
  double stable_step_;
};

}  // namespace contactcheck
