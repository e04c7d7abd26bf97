#include "core/dynamics/finite_elements.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/core/dynamics/model_states.h"

namespace contactcheck {
namespace {

Material rubber() {
  Material material;
  material.model = DeformableModel::kFiniteElements;
  material.youngs_modulus = 1e5;
  material.poisson_ratio = 0.3;
  return material;
}

// The block, its inner grid lines moved so that no two cells have the same sides.
Lattice uneven_lattice() {
  Lattice lattice = *test::block_shape()->lattice;
  for (int k = 0; k < 3; ++k) lattice.lines[k][1] += 0.04 * (k + 1);
  return lattice;
}

std::vector<Vec3> forces_at(const FiniteElements& model, const std::vector<Vec3>& positions) {
  std::vector<Vec3> forces(positions.size(), Vec3::Zero());
  model.add_forces(positions, std::vector<Vec3>(positions.size(), Vec3::Zero()), forces);
  return forces;
}

bool on_surface(const Lattice& lattice, std::uint32_t node) {
  for (int k = 0; k < 3; ++k)
    if (lattice.nodes[node][k] == 0 || lattice.nodes[node][k] + 1 == lattice.lines[k].size())
      return true;
  return false;
}

TEST(FiniteElements, UniformStrainIsReproducedExactly) {
  const Lattice lattice = uneven_lattice();
  const Material material = rubber();
  const FiniteElements model(lattice, material);
  Mat3 strain;  // symmetric: no rotation
  strain << 0.02, 0.01, -0.015, 0.01, -0.03, 0.005, -0.015, 0.005, 0.01;
  const Mat3 r = test::rotation_of(1, 2, 3, 4);
  const std::vector<Vec3> positions =
      test::moved(lattice.rest_nodes(), r * (Mat3::Identity() + strain), {5, 6, 7});

  const double mu = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
  const double lambda = 2 * mu * material.poisson_ratio / (1 - 2 * material.poisson_ratio);
  double volume = 1.0;
  for (const auto& lines : lattice.lines) volume *= lines.back() - lines.front();
  const double energy =
      volume * (0.5 * lambda * strain.trace() * strain.trace() + mu * strain.squaredNorm());
  EXPECT_NEAR(model.elastic_energy(positions) / energy, 1.0, 1e-12);

  const std::vector<Vec3> forces = forces_at(model, positions);
  double outer = 0.0;
  int inner_nodes = 0;
  for (std::uint32_t n = 0; n < forces.size(); ++n) {
    if (on_surface(lattice, n)) {
      outer = std::max(outer, forces[n].norm());
    } else {
      EXPECT_LT(forces[n].norm(), 1e-9) << n;
      ++inner_nodes;
    }
  }
  EXPECT_EQ(inner_nodes, 3 * 2 * 1);
  EXPECT_GT(outer, 10.0);
}

TEST(FiniteElements, ForceIsMinusTheGradientOfTheEnergy) {
  const Lattice lattice = uneven_lattice();
  const FiniteElements model(lattice, rubber());
  std::vector<Vec3> positions = lattice.rest_nodes();
  test::Noise noise;
  for (Vec3& p : positions) p += noise.vector() * 0.03;
  positions = test::moved(positions, test::rotation_of(3, -1, 2, 2), {1, 0, 0});
  double largest = 0.0;
  for (const Vec3& f : forces_at(model, positions)) largest = std::max(largest, f.norm());
  EXPECT_LT(test::worst_gradient_error(model, positions, 1e-6), 1e-6 * largest);
}

TEST(FiniteElements, DampingTakesEnergyButNeitherMomentum) {
  const auto shape = test::block_shape();
  Material damped = rubber();
  damped.damping_time = 0.01;
  const FiniteElements model(*shape->lattice, damped);
  NodeState state = test::disturbed(*shape, 0.03);
  test::Noise noise;
  for (Vec3& v : state.velocities) v = noise.vector();
  const std::vector<Vec3> elastic = forces_at(model, state.positions);
  std::vector<Vec3> all(elastic.size(), Vec3::Zero());
  model.add_forces(state.positions, state.velocities, all);
  double power = 0.0, size = 0.0;
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Vec3 damping = all[n] - elastic[n];
    power += damping.dot(state.velocities[n]);
    size += damping.norm();
    sum += damping;
    torque += state.positions[n].cross(damping);
  }
  EXPECT_LT(power, -1.0);
  EXPECT_LT(sum.norm(), 1e-12 * size);
  EXPECT_LT(torque.norm(), 1e-12 * size);
}

TEST(FiniteElements, RigidMotionIsNotDampedWhateverTheStrain) {
  const auto shape = test::block_shape();
  const FiniteElements model(*shape->lattice, rubber());
  NodeState state = test::disturbed(*shape, 0.03);
  for (std::size_t n = 0; n < state.positions.size(); ++n)
    state.velocities[n] = Vec3(3, 1, -2) + Vec3(1, -4, 2).cross(state.positions[n]);
  const std::vector<Vec3> elastic = forces_at(model, state.positions);
  std::vector<Vec3> all(elastic.size(), Vec3::Zero());
  model.add_forces(state.positions, state.velocities, all);
  for (std::size_t n = 0; n < all.size(); ++n)
    EXPECT_LT((all[n] - elastic[n]).norm(), 1e-9 * elastic[n].norm());
}

TEST(FiniteElements, InvertedElementIsDrivenBack) {
  const auto shape = make_shape(test::unit_box_mesh(1), {1, 1, 1});
  const FiniteElements model(*shape->lattice, rubber());
  NodeState state = test::at_rest(*shape);
  for (Vec3& p : state.positions) p.z() = 0.5 - 0.4 * (p.z() - 0.5);  // inside out along z
  const double dt = model.stable_step();
  for (int i = 0; i < 20000; ++i) model.step(dt, Vec3::Zero(), state);
  EXPECT_LT(model.elastic_energy(state.positions), 1e-9);
  // The rest shape and not its mirror image.
  const CornerIds& ids = shape->lattice->cell_nodes[0];
  const Vec3 x = state.positions[ids[1]] - state.positions[ids[0]];
  const Vec3 y = state.positions[ids[2]] - state.positions[ids[0]];
  const Vec3 z = state.positions[ids[4]] - state.positions[ids[0]];
  EXPECT_GT(x.cross(y).dot(z), 1.0);
}

// A bar of 8 x 1 x 1 m (and the padding), held at its low end in x.
struct Bar {
  explicit Bar(const Resolution& resolution)
      : shape(make_shape(test::box_mesh({0, 0, 0}, {8, 1, 1}, 16), resolution)),
        model(*shape->lattice, rubber()) {
    for (int k = 0; k < 3; ++k)
      sides[k] = shape->lattice->lines[k].back() - shape->lattice->lines[k].front();
  }
  double area() const { return sides.y() * sides.z(); }
  bool at_tip(std::uint32_t n) const {
    return shape->lattice->nodes[n][0] + 1 == shape->lattice->lines[0].size();
  }
  std::shared_ptr<const BodyShape> shape;
  FiniteElements model;
  Vec3 sides;
};

// Minus the derivative of the forces by the positions, by central differences.
Eigen::MatrixXd stiffness_at(const FiniteElements& model, std::vector<Vec3> positions) {
  const auto n = static_cast<Eigen::Index>(3 * positions.size());
  Eigen::MatrixXd stiffness(n, n);
  constexpr double kStep = 1e-5;  // of a size of metres
  for (Eigen::Index i = 0; i < n; ++i) {
    double& x = positions[static_cast<std::size_t>(i / 3)][i % 3];
    const double at = x;
    x = at - kStep;
    const std::vector<Vec3> low = forces_at(model, positions);
    x = at + kStep;
    const std::vector<Vec3> high = forces_at(model, positions);
    x = at;
    for (std::size_t k = 0; k < low.size(); ++k)
      stiffness.block<3, 1>(static_cast<Eigen::Index>(3 * k), i) =
          (low[k] - high[k]) / (2.0 * kStep);
  }
  return stiffness;
}

// Mean displacement of the tip under a load spread over it by area, held end fixed, small strain.
// The bar is turned first, the load with it; the answer is turned back.
Vec3 tip_displacement(const Bar& bar, const Vec3& load, const Mat3& turned) {
  const Lattice& lattice = *bar.shape->lattice;
  Eigen::MatrixXd k = stiffness_at(bar.model, test::moved(lattice.rest_nodes(), turned, {0, 0, 0}));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(k.rows());
  double tip_mass = 0.0;
  for (std::uint32_t n = 0; n < lattice.nodes.size(); ++n)
    if (bar.at_tip(n)) tip_mass += bar.model.masses()[n];
  for (std::uint32_t n = 0; n < lattice.nodes.size(); ++n) {
    if (bar.at_tip(n)) f.segment<3>(3 * n) = turned * load * (bar.model.masses()[n] / tip_mass);
    if (lattice.nodes[n][0] > 0) continue;
    k.middleRows<3>(3 * n).setZero();
    k.middleCols<3>(3 * n).setZero();
    k.block<3, 3>(3 * n, 3 * n).setIdentity();
  }
  const Eigen::VectorXd u = k.partialPivLu().solve(f);
  Vec3 mean = Vec3::Zero();
  for (std::uint32_t n = 0; n < lattice.nodes.size(); ++n)
    if (bar.at_tip(n)) mean += u.segment<3>(3 * n) * (bar.model.masses()[n] / tip_mass);
  return turned.transpose() * mean;
}

constexpr double kClosedForm = 0.05;  // the end that is held whole is stiffer than the theory's

TEST(FiniteElements, StretchedBarLengthensByForceTimesLengthOverStiffness) {
  for (const Resolution& r : {Resolution{8, 1, 1}, Resolution{16, 2, 2}}) {
    const Bar bar(r);
    const double expected = bar.sides.x() / (rubber().youngs_modulus * bar.area());
    const Vec3 tip = tip_displacement(bar, {1, 0, 0}, Mat3::Identity());
    EXPECT_NEAR(tip.x() / expected, 1.0, kClosedForm);
    EXPECT_LT(std::abs(tip.y()) + std::abs(tip.z()), 1e-6 * tip.x());
  }
}

TEST(FiniteElements, CantileverBendsAsTimoshenkosBeam) {
  // One layer of cells is enough: without the inner parabolas it would be several times too stiff.
  for (const Resolution& r : {Resolution{8, 1, 1}, Resolution{16, 2, 2}, Resolution{4, 1, 1}}) {
    const Bar bar(r);
    const double e = rubber().youngs_modulus, length = bar.sides.x();
    const double inertia = bar.sides.y() * std::pow(bar.sides.z(), 3) / 12.0;
    const double shear = e / (2.0 * (1.0 + rubber().poisson_ratio)) * bar.area() * 5.0 / 6.0;
    const double expected = std::pow(length, 3) / (3.0 * e * inertia) + length / shear;
    const Vec3 tip = tip_displacement(bar, {0, 0, 1}, Mat3::Identity());
    EXPECT_NEAR(tip.z() / expected, 1.0, kClosedForm) << r.x;
  }
}

TEST(FiniteElements, RotatedBarBendsTheSame) {
  const Bar bar({8, 1, 1});
  const Vec3 straight = tip_displacement(bar, {0, 0.5, 1}, Mat3::Identity());
  const Vec3 turned = tip_displacement(bar, {0, 0.5, 1}, test::rotation_of(1, -2, 3, 1));
  // The differences that give the stiffness are good to 1e-10 of it, the thin bar's condition
  // number is some 1e4.
  EXPECT_LT((turned - straight).norm(), 1e-6 * straight.norm());
}

TEST(HexahedronStiffness, EigenvalueBoundIsTight) {
  for (const Vec3& sides : {Vec3(1, 1, 1), Vec3(0.1, 0.2, 0.7), Vec3(0.05, 2, 1)}) {
    const HexahedronStiffness k = hexahedron_stiffness(sides, 1e5, 0.45);
    const Eigen::Map<const Eigen::Matrix<double, 24, 24>> matrix(k.data());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>> solver(matrix);
    const double ratio = largest_eigenvalue_bound(k) / solver.eigenvalues()[23];
    EXPECT_GT(ratio, 1.0 - 1e-12);
    EXPECT_LT(ratio, 1.026);
    // Six rigid motions and no more.
    EXPECT_LT(solver.eigenvalues()[5], 1e-12 * solver.eigenvalues()[23]);
    EXPECT_GT(solver.eigenvalues()[6], 1e-7 * solver.eigenvalues()[23]);
  }
}

}  // namespace
}  // namespace contactcheck
