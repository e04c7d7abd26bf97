#include "core/dynamics/finite_elements.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/dynamics/fixed_order.h"
#include "core/dynamics/polar_rotation.h"
#include "core/dynamics/verlet.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr int kShapes = 8 + 3;       // corners, then one parabola per axis
constexpr int kInner = 3 * kShapes;  // displacements with the inner ones
constexpr int kOuter = 3 * 8;        // displacements of the corners

using Gradients = std::array<Vec3, kShapes>;
using InnerStiffness = std::array<std::array<double, kInner>, kInner>;

double side_of(int corner, int axis) { return (corner >> axis & 1) ? 1.0 : -1.0; }

// At a point of the element in [-1, 1]^3. Parabola m is 1 - p_m^2.
Gradients gradients_at(const Vec3& p, const Vec3& sides) {
  Gradients out;
  for (int c = 0; c < 8; ++c) {
    Vec3 factor;
    for (int k = 0; k < 3; ++k) factor[k] = 0.5 * (1.0 + side_of(c, k) * p[k]);
    for (int k = 0; k < 3; ++k)
      out[c][k] = side_of(c, k) / sides[k] * factor[(k + 1) % 3] * factor[(k + 2) % 3];
  }
  for (int m = 0; m < 3; ++m) out[8 + m] = Vec3::Unit(m) * (-4.0 * p[m] / sides[m]);
  return out;
}

// Adds weight times the energy density of Hooke's law with Lame's constants, as a bilinear form.
void add_point(const Gradients& g, double weight, double lambda, double mu, InnerStiffness& k) {
  for (int a = 0; a < kShapes; ++a)
    for (int b = 0; b < kShapes; ++b) {
      const double dot = ordered_dot(g[a], g[b]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          k[3 * a + i][3 * b + j] += weight * (lambda * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i] +
                                               (i == j ? mu * dot : 0.0));
    }
}

// Static condensation: the inner displacements take the values of least energy.
void eliminate_inner(InnerStiffness& k) {
  for (int p = kInner - 1; p >= kOuter; --p)
    for (int i = 0; i < p; ++i) {
      const double factor = k[i][p] / k[p][p];
      for (int j = 0; j < p; ++j) k[i][j] -= factor * k[p][j];
    }
}

double frobenius(const HexahedronStiffness& m) {
  double sum = 0.0;
  for (double x : m) sum += x * x;
  return std::sqrt(sum);
}

HexahedronStiffness squared(const HexahedronStiffness& m, double scale) {
  HexahedronStiffness out{};
  for (int i = 0; i < 24; ++i)
    for (int p = 0; p < 24; ++p) {
      const double factor = m[24 * i + p] * scale * scale;
      for (int k = 0; k < 24; ++k) out[24 * i + k] += factor * m[24 * p + k];
    }
  return out;
}

}  // namespace

HexahedronStiffness hexahedron_stiffness(const Vec3& sides, double youngs_modulus,
                                         double poisson_ratio) {
  CONTACTCHECK_INVARIANT(youngs_modulus > 0.0 && poisson_ratio >= 0.0 && poisson_ratio < 0.5,
                         "the material is solid and can be compressed");
  const double mu = youngs_modulus / (2.0 * (1.0 + poisson_ratio));
  const double lambda = 2.0 * mu * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
  const double weight = sides.x() * sides.y() * sides.z() / 8.0;
  const double at = 1.0 / std::sqrt(3.0);
  InnerStiffness inner{};
  for (int point = 0; point < 8; ++point) {
    const Vec3 p(at * side_of(point, 0), at * side_of(point, 1), at * side_of(point, 2));
    add_point(gradients_at(p, sides), weight, lambda, mu, inner);
  }
  eliminate_inner(inner);
  HexahedronStiffness out;
  for (int i = 0; i < kOuter; ++i)
    for (int k = 0; k < kOuter; ++k) out[24 * i + k] = 0.5 * (inner[i][k] + inner[k][i]);
  return out;
}

// Takes the 64th root of the Frobenius norm of K^64 (K squared six times). That norm is at most
// sqrt(24) times the largest eigenvalue of K^64, so the root is at most 24^(1/128) = 1.026 times
// that of K. Each power is normalised, so that none overflows.
double largest_eigenvalue_bound(const HexahedronStiffness& stiffness) {
  constexpr int kSquarings = 6;
  HexahedronStiffness power = stiffness;
  std::array<double, kSquarings> norms;
  for (double& norm : norms) {
    norm = frobenius(power);
    if (norm == 0.0) return 0.0;
    power = squared(power, 1.0 / norm);
  }
  double bound = frobenius(power);
  for (int i = kSquarings - 1; i >= 0; --i) bound = norms[i] * std::sqrt(bound);
  return bound;
}

Vec3 corner_gradient(int corner, const Vec3& sides) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) out[k] = side_of(corner, k) / (4.0 * sides[k]);
  return out;
}

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
