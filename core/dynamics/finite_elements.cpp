#include "core/dynamics/finite_elements.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/polar_rotation.h"
#include "core/dynamics/verlet.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

// Relative. The cells of a regular lattice differ by the rounding of its lines, far below this, and
// share one stiffness, which then stays in the cache. The stiffness follows the sides smoothly: it
// is wrong by no more than this.
constexpr double kSameSides = 1e-9;
// Turn of an element's rotation per curl of its deformation gradient: 1/2 at rest, 1 when it is
// pressed to half its size. Without a limit the force would have a pole where the best rotation
// jumps; a higher one asks for shorter steps.
constexpr double kMostSpin = 10.0;

bool same_sides(const Vec3& a, const Vec3& b) {
  return ((a - b).array().abs() <= kSameSides * a.array()).all();
}

// With S the symmetric stretch, a change of the corners whose deformation gradient has the curl c
// (turned back) turns the rotation by (tr(S) I - S)^-1 c.
Mat3 spin_of(const Mat3& stretch) {
  Mat3 g = -0.5 * (stretch + stretch.transpose());
  for (int k = 0; k < 3; ++k) g(k, k) += stretch(0, 0) + stretch(1, 1) + stretch(2, 2);
  const Mat3 cofactor = cofactors(g);
  const Mat3 inverse = cofactor / ordered_dot(g.col(0), cofactor.col(0));
  const bool bounded = (inverse.array().abs() <= kMostSpin).all();  // false for NaN
  return bounded ? inverse : Mat3(Mat3::Zero());
}

}  // namespace

FiniteElements::FiniteElements(const Lattice& lattice, const Material& material)
    : damping_time_(material.damping_time), masses_(node_masses(lattice, material.mass)) {
  CONTACTCHECK_INVARIANT(damping_time_ >= 0.0, "damping looks ahead, not back");
  for (std::uint32_t c = 0; c < lattice.cells.size(); ++c)
    elements_.push_back({lattice.cell_nodes[c], kind_of(lattice.cell_box(c).extent(), material)});
  stable_step_ = longest_step(lattice, material);
}

std::uint32_t FiniteElements::kind_of(const Vec3& sides, const Material& material) {
  const auto known = std::find_if(kinds_.begin(), kinds_.end(),
                                  [&](const Kind& k) { return same_sides(k.sides, sides); });
  if (known != kinds_.end()) return static_cast<std::uint32_t>(known - kinds_.begin());
  Kind kind;
  kind.sides = sides;
  for (int c = 0; c < 8; ++c) {
    kind.rest[c] = Vec3((c & 1) * sides.x(), (c >> 1 & 1) * sides.y(), (c >> 2) * sides.z());
    kind.gradients[c] = corner_gradient(c, sides);
  }
  kind.stiffness = hexahedron_stiffness(sides, material.youngs_modulus, material.poisson_ratio);
  kinds_.push_back(kind);
  return static_cast<std::uint32_t>(kinds_.size() - 1);
}

// A node's mass is the sum of what its cells give it, so no mode of the body is faster than the
// fastest of a single cell with its own share of the mass (Irons & Treharne 1971).
double FiniteElements::longest_step(const Lattice& lattice, const Material& material) const {
  double volume = 0.0;
  for (const Element& e : elements_) volume += kinds_[e.kind].sides.prod();
  CONTACTCHECK_INVARIANT(lattice.cells.size() == elements_.size(), "one element per kept cell");
  double bound = 0.0;
  for (const Kind& k : kinds_) {
    const double corner_mass = material.mass * (k.sides.prod() / volume) / 8.0;
    bound = std::max(bound, largest_eigenvalue_bound(k.stiffness) / corner_mass);
  }
  return kStrainMargin * longest_verlet_step(bound, damping_time_ * bound);
}

void FiniteElements::step(double dt, const Vec3& acceleration, NodeState& state) const {
  verlet_step(dt, acceleration, masses_, state,
              [this](auto positions, auto velocities, auto forces) {
                add_forces(positions, velocities, forces);
              });
}

FiniteElements::Pose FiniteElements::pose_of(const Element& element,
                                             std::span<const Vec3> positions) const {
  const Kind& kind = kinds_[element.kind];
  Corners relative;
  Mat3 gradient = Mat3::Zero();
  for (int c = 0; c < 8; ++c) {
    relative[c] = positions[element.nodes[c]] - positions[element.nodes[0]];
    add_outer(gradient, 1.0, relative[c], kind.gradients[c]);
  }
  Pose pose;
  // Only NaN and infinity do not converge, and they reach the caller in the positions.
  pose.rotation = polar_rotation(gradient).rotation;
  for (int c = 0; c < 8; ++c) pose.corners[c] = transposed_product(pose.rotation, relative[c]);
  pose.spin = spin_of(transposed_product(pose.rotation, gradient));
  return pose;
}

FiniteElements::Displacements FiniteElements::strained(const Element& element,
                                                       const Pose& pose) const {
  Displacements u;
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) u[3 * c + k] = pose.corners[c][k] - kinds_[element.kind].rest[c][k];
  return u;
}

// Adds the damping time's worth of the rate of u = R^T x - X.
void FiniteElements::add_rates(const Element& element, const Pose& pose,
                               std::span<const Vec3> velocities, Displacements& u) const {
  Corners rates;
  Vec3 curl = Vec3::Zero();
  for (int c = 0; c < 8; ++c) {
    const Vec3 relative = velocities[element.nodes[c]] - velocities[element.nodes[0]];
    rates[c] = transposed_product(pose.rotation, relative);
    curl += kinds_[element.kind].gradients[c].cross(rates[c]);
  }
  const Vec3 turn = ordered_product(pose.spin, curl);
  for (int c = 0; c < 8; ++c) {
    const Vec3 rate = rates[c] - turn.cross(pose.corners[c]);
    for (int k = 0; k < 3; ++k) u[3 * c + k] += damping_time_ * rate[k];
  }
}

// K u, per corner. Row by row over contiguous sums: the compiler may use SIMD without changing the
// order of any addition.
Corners FiniteElements::answer(const HexahedronStiffness& stiffness, const Displacements& u) {
  Displacements sums{};
  for (int i = 0; i < 24; ++i)
    for (int k = 0; k < 24; ++k) sums[k] += stiffness[24 * i + k] * u[i];
  Corners out;
  for (std::size_t c = 0; c < 8; ++c) out[c] = Vec3(sums[3 * c], sums[3 * c + 1], sums[3 * c + 2]);
  return out;
}

void FiniteElements::add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                                std::span<Vec3> forces) const {
  for (const Element& element : elements_) {
    const Kind& kind = kinds_[element.kind];
    const Pose pose = pose_of(element, positions);
    Displacements u = strained(element, pose);
    if (damping_time_ > 0.0) add_rates(element, pose, velocities, u);
    const Corners answers = answer(kind.stiffness, u);
    // The answers pull at the turned-back corners and would turn the element by themselves where it
    // is strained; what the rotation's own change adds takes that torque away again.
    Vec3 torque = Vec3::Zero();
    for (int c = 0; c < 8; ++c) torque += pose.corners[c].cross(answers[c]);
    const Vec3 turn = ordered_product(pose.spin, torque);
    for (int c = 0; c < 8; ++c)
      forces[element.nodes[c]] -=
          ordered_product(pose.rotation, answers[c] - turn.cross(kind.gradients[c]));
  }
}

double FiniteElements::elastic_energy(std::span<const Vec3> positions) const {
  double sum = 0.0;
  for (const Element& element : elements_) {
    const Displacements u = strained(element, pose_of(element, positions));
    const Corners answers = answer(kinds_[element.kind].stiffness, u);
    for (std::size_t c = 0; c < 8; ++c)
      sum += ordered_dot(answers[c], Vec3(u[3 * c], u[3 * c + 1], u[3 * c + 2]));
  }
  return 0.5 * sum;
}

}  // namespace contactcheck
