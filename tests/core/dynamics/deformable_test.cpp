// What all models promise, each with the same body.
#include "core/dynamics/deformable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>

#include "tests/core/dynamics/model_states.h"

namespace contactcheck {
namespace {

struct Sample {
  std::string name;
  Material material;
  bool conserves;  // without damping, energy stays
};

// What a failure names instead of the bytes.
void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.name; }

Material material_of(DeformableModel model) {
  Material material;
  material.model = model;
  material.mass = 2.0;
  material.stiffness = 300.0;
  material.damping = 0.0;
  material.youngs_modulus = 2e4;
  material.damping_time = 0.0;
  material.relaxation_time = 0.03;
  return material;
}

std::vector<Sample> samples() {
  Material shape = material_of(DeformableModel::kShapeMatching), whole = shape;
  shape.region = 1;
  whole.region = 0;
  return {{"MassSpring", material_of(DeformableModel::kMassSpring), true},
          {"FiniteElements", material_of(DeformableModel::kFiniteElements), true},
          {"ShapeMatching", shape, false},
          {"ShapeMatchingWhole", whole, false}};
}

Material damped(Material material) {
  material.damping = 0.5;
  material.damping_time = 0.01;
  return material;
}

class Models : public ::testing::TestWithParam<Sample> {
 protected:
  std::unique_ptr<const Deformable> make(const Material& material) const {
    return make_deformable(*shape_, material);
  }
  // As long as is stable, where that is limited; else a frame.
  static double step_of(const Deformable& model) { return std::min(model.stable_step(), 1.0 / 60); }

  std::shared_ptr<const BodyShape> shape_ = test::block_shape();
};

INSTANTIATE_TEST_SUITE_P(Deformable, Models, ::testing::ValuesIn(samples()),
                         [](const auto& sample) { return sample.param.name; });

TEST(NodeMasses, AreEighthsOfTheCellsByVolume) {
  // Cells of 1 x 2 x 2 and 3 x 2 x 2: a quarter and three quarters of 16 kg.
  Lattice lattice = *make_shape(test::unit_box_mesh(2), {2, 1, 1}, 0.5)->lattice;
  lattice.lines[0] = {0.0, 1.0, 4.0};
  const std::vector<double> masses = node_masses(lattice, 16.0);
  for (std::uint32_t n = 0; n < masses.size(); ++n)
    EXPECT_DOUBLE_EQ(masses[n], (std::array{0.5, 2.0, 1.5})[lattice.nodes[n][0]]) << n;
}

TEST_P(Models, MassesSumUpToTheBody) {
  const auto model = make(GetParam().material);
  double sum = 0.0;
  for (double m : model->masses()) {
    EXPECT_GT(m, 0.0);
    sum += m;
  }
  EXPECT_NEAR(sum, 2.0, 1e-14);
}

TEST_P(Models, FreeFallFollowsTheClosedForm) {
  const auto model = make(damped(GetParam().material));
  const Vec3 gravity(0.3, -9.81, 1.7), start(2, 5, -1);
  NodeState state = test::at_rest(*shape_);
  for (Vec3& v : state.velocities) v = start;
  const double dt = step_of(*model);
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) model->step(dt, gravity, state);
  const double t = kSteps * dt;
  const Vec3 fallen = start * t + gravity * (0.5 * t * t), velocity = start + gravity * t;
  const std::vector<Vec3> rest = shape_->lattice->rest_nodes();
  for (std::size_t n = 0; n < rest.size(); ++n) {
    EXPECT_LT((state.positions[n] - rest[n] - fallen).norm(), 1e-12 * (1.0 + fallen.norm()));
    EXPECT_LT((state.velocities[n] - velocity).norm(), 1e-12 * velocity.norm());
  }
}

TEST_P(Models, RestAndItsRigidCopiesHaveNoEnergyAndStayAsTheyAre) {
  const auto model = make(GetParam().material);
  for (const Mat3& r : {test::rotation_of(1, 0, 0, 0), test::rotation_of(1, 1, 1, 0),
                        test::rotation_of(0, 0, 1, 0), test::rotation_of(3, -4, 1, 2)}) {
    NodeState state = test::at_rest(*shape_);
    state.positions = test::moved(state.positions, r, {10, -20, 30});
    const std::vector<Vec3> before = state.positions;
    EXPECT_LT(model->elastic_energy(state.positions), 1e-22);
    for (int i = 0; i < 100; ++i) model->step(step_of(*model), Vec3::Zero(), state);
    for (std::size_t n = 0; n < before.size(); ++n)
      EXPECT_LT((state.positions[n] - before[n]).norm(), 1e-11);
  }
}

TEST_P(Models, VibratingBodyKeepsItsMomenta) {
  for (const Material& material : {GetParam().material, damped(GetParam().material)}) {
    const auto model = make(material);
    NodeState state = test::disturbed(*shape_, 0.05);
    for (std::size_t n = 0; n < state.positions.size(); ++n)
      state.velocities[n] = Vec3(1, 2, -1) + Vec3(2, -1, 3).cross(state.positions[n]);
    const Vec3 linear = test::momentum(model->masses(), state);
    const Vec3 angular = test::angular_momentum(model->masses(), state);
    const double elastic = model->elastic_energy(state.positions);
    double least = elastic;
    for (int i = 0; i < 500; ++i) {
      model->step(step_of(*model), Vec3::Zero(), state);
      least = std::min(least, model->elastic_energy(state.positions));
    }
    EXPECT_LT(least, 0.8 * elastic);  // it does move
    EXPECT_LT((test::momentum(model->masses(), state) - linear).norm(), 1e-11 * linear.norm());
    EXPECT_LT((test::angular_momentum(model->masses(), state) - angular).norm(),
              1e-11 * angular.norm());
  }
}

// Nodes displaced by a fifth of a cell: strains up to some 40 %.
TEST_P(Models, EnergyStaysBoundedAtTheStableStep) {
  for (const Material& material : {GetParam().material, damped(GetParam().material)}) {
    const auto model = make(material);
    NodeState state = test::disturbed(*shape_, 0.06);
    const double start = test::energy(*model, state);
    double most = 0.0;
    for (int i = 0; i < 10000; ++i) {
      model->step(step_of(*model), Vec3::Zero(), state);
      most = std::max(most, test::energy(*model, state));
    }
    // Verlet steps keep an energy near to the true one, which swings round it with the share of the
    // step in the fastest period: (w h)^2 / 4, at most 0.75^2.
    EXPECT_LT(most, 2.5 * start);
    EXPECT_TRUE(std::isfinite(test::energy(*model, state)));
    if (GetParam().conserves && material.damping == 0.0) {
      EXPECT_GT(test::energy(*model, state), 0.3 * start);
    }
  }
}

TEST_P(Models, DampedBodyReturnsToItsShape) {
  const auto model = make(damped(GetParam().material));
  NodeState state = test::disturbed(*shape_, 0.05);
  const double start = test::energy(*model, state);
  for (int i = 0; i < 20000; ++i) model->step(step_of(*model), Vec3::Zero(), state);
  EXPECT_LT(test::energy(*model, state), 1e-10 * start);
  const std::vector<Vec3> rest = shape_->lattice->rest_nodes();
  for (std::size_t n = 1; n < rest.size(); ++n)
    EXPECT_NEAR((state.positions[n] - state.positions[0]).norm(), (rest[n] - rest[0]).norm(), 1e-5);
}

// The step, as a multiple of the promised one, from which a small disturbance grows a million
// times.
double growing_from(const Deformable& model, const BodyShape& shape) {
  for (double multiple = 1.0; multiple < 5.0; multiple += 0.1) {
    NodeState state = test::disturbed(shape, 1e-9);
    const double start = test::energy(model, state);
    for (int i = 0; i < 1000; ++i) model.step(multiple * model.stable_step(), Vec3::Zero(), state);
    if (!(test::energy(model, state) < 1e6 * start)) return multiple;
  }
  return 5.0;
}

TEST_P(Models, StepBeyondTheBoundBlowsUpAndTheBoundIsNotIdle) {
  if (!GetParam().conserves) {
    EXPECT_EQ(make(GetParam().material)->stable_step(), std::numeric_limits<double>::infinity());
    return;
  }
  for (const Material& material : {GetParam().material, damped(GetParam().material)}) {
    const double limit = growing_from(*make(material), *shape_);
    RecordProperty(material.damping > 0.0 ? "damped" : "undamped", std::to_string(limit));
    EXPECT_GT(limit, 4.0 / 3.0);  // the margin for strain
    EXPECT_LT(limit, 3.0);
  }
}

TEST_P(Models, DampingShortensTheStableStep) {
  if (!GetParam().conserves) return;
  EXPECT_LT(make(damped(GetParam().material))->stable_step(),
            0.9 * make(GetParam().material)->stable_step());
}

TEST_P(Models, TwoRunsGiveTheSameBits) {
  const auto run = [&] {
    const auto model = make(damped(GetParam().material));
    NodeState state = test::disturbed(*shape_, 0.05);
    for (int i = 0; i < 100; ++i) model->step(step_of(*model), {0, -9.81, 0}, state);
    return state;
  };
  const NodeState one = run(), two = run();
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.velocities, two.velocities);
}

}  // namespace
}  // namespace contactcheck
