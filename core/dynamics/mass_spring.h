// Masses on the lattice nodes, damped springs between all nodes of a cell: the paper's own model.
// Source: Jeon, Hong, Choi, Jeong 2013 ("Updating MSS").
//
// The step is explicit (verlet.h). The paper's bodies are soft: a kilogram on some 300 nodes with
// springs of 1,000 N/m shivers at 2,300 rad/s at most, which asks for some 25 steps per frame of
// 1/60 s without damping (more with it: damping times the squared frequency over the stiffness
// limits the step as well). Each costs one pass over the springs, about what one iteration of the
// linear solver of an implicit step would, and damps nothing that the scene does not damp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/deformable.h"

namespace contactcheck {

/// Two nodes, a < b.
struct Spring {
  std::uint32_t a = 0, b = 0;
  double rest_length = 0.0;  ///< metres
};

/// The 12 edges, 12 face diagonals and 4 body diagonals of every kept cell, each pair of nodes
/// once, ascending in (a, b).
std::vector<Spring> lattice_springs(const Lattice& lattice);

class MassSpring final : public Deformable {
 public:
  /// @pre the shape has a lattice; mass above 0, stiffness and damping not negative
  MassSpring(const Lattice& lattice, const Material& material);

  std::span<const double> masses() const override { return masses_; }
  void step(double dt, const Vec3& acceleration, NodeState& state) const override;
  double stable_step() const override { return stable_step_; }
  double elastic_energy(std::span<const Vec3> positions) const override;

  /// Adds the force of every spring, newtons; a spring of length zero has no direction and gives
  /// none.
  void add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                  std::span<Vec3> forces) const;

  std::span<const Spring> springs() const { return springs_; }

 private:
  double stiffness_, damping_;
  std::vector<double> masses_;
  std::vector<Spring> springs_;
  double stable_step_;
};

}  // namespace contactcheck
