#include "core/dynamics/mass_spring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dynamics/fixed_order.h"
#include "core/dynamics/verlet.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

// An upper bound, 1/kg, of the eigenvalues of M^-1 B, with B the sum of the springs' n n^T at rest:
// times the stiffness it bounds the squared frequencies, times the damping their decay.
//
// With (p - q)^2 <= (1/m_a + 1/m_b) (m_a p^2 + m_b q^2), each spring's energy is split between its
// two nodes, so that the eigenvalues are bounded by those of one 3x3 matrix per node, and these by
// the largest row sum (Gershgorin).
double modal_bound(const std::vector<Spring>& springs, const std::vector<Vec3>& rest,
                   const std::vector<double>& masses) {
  std::vector<Mat3> at_node(rest.size(), Mat3::Zero());
  for (const Spring& s : springs) {
    const Vec3 n = (rest[s.b] - rest[s.a]) / s.rest_length;
    const double weight = 1.0 / masses[s.a] + 1.0 / masses[s.b];
    add_outer(at_node[s.a], weight, n, n);
    add_outer(at_node[s.b], weight, n, n);
  }
  double bound = 0.0;
  for (const Mat3& m : at_node)
    for (int k = 0; k < 3; ++k)
      bound = std::max(bound, std::abs(m(0, k)) + std::abs(m(1, k)) + std::abs(m(2, k)));
  return bound;
}

}  // namespace

std::vector<Spring> lattice_springs(const Lattice& lattice) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(28 * lattice.cell_nodes.size());
  for (const CornerIds& ids : lattice.cell_nodes)
    for (int i = 0; i < 8; ++i)
      for (int k = i + 1; k < 8; ++k) pairs.push_back(std::minmax(ids[i], ids[k]));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Spring> springs;
  springs.reserve(pairs.size());
  for (const auto& [a, b] : pairs) {
    const Vec3 d = lattice.rest_node(b) - lattice.rest_node(a);
    springs.push_back({a, b, std::sqrt(ordered_dot(d, d))});
  }
  return springs;
}

MassSpring::MassSpring(const Lattice& lattice, const Material& material)
    : stiffness_(material.stiffness),
      damping_(material.damping),
      masses_(node_masses(lattice, material.mass)),
      springs_(lattice_springs(lattice)) {
  CONTACTCHECK_INVARIANT(stiffness_ >= 0.0 && damping_ >= 0.0, "springs do not push away");
  // Stiffness and damping have the same modes, those of B: their bounds rise together.
  const double bound = modal_bound(springs_, lattice.rest_nodes(), masses_);
  stable_step_ = kStrainMargin * longest_verlet_step(stiffness_ * bound, damping_ * bound);
}

void MassSpring::step(double dt, const Vec3& acceleration, NodeState& state) const {
  verlet_step(dt, acceleration, masses_, state,
              [this](auto positions, auto velocities, auto forces) {
                add_forces(positions, velocities, forces);
              });
}

void MassSpring::add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                            std::span<Vec3> forces) const {
  for (const Spring& s : springs_) {
    const Vec3 d = positions[s.b] - positions[s.a];
    const double length = std::sqrt(ordered_dot(d, d));
    if (length == 0.0) continue;
    const double inverse = 1.0 / length;
    const double rate = ordered_dot(velocities[s.b] - velocities[s.a], d) * inverse;
    const double tension = stiffness_ * (length - s.rest_length) + damping_ * rate;
    const Vec3 force = d * (tension * inverse);
    forces[s.a] += force;
    forces[s.b] -= force;
  }
}

double MassSpring::elastic_energy(std::span<const Vec3> positions) const {
  double sum = 0.0;
  for (const Spring& s : springs_) {
    const Vec3 d = positions[s.b] - positions[s.a];
    const double stretch = std::sqrt(ordered_dot(d, d)) - s.rest_length;
    sum += stretch * stretch;
  }
  return 0.5 * stiffness_ * sum;
}

}  // namespace contactcheck
