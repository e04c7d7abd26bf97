#include "core/dynamics/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/dynamics/model_states.h"
#include "tests/core/dynamics/simulated_boxes.h"

namespace contactcheck {
namespace {

using test::box_body;
using test::moving;

class EveryModel : public ::testing::TestWithParam<DeformableModel> {};

std::string model_name(const ::testing::TestParamInfo<DeformableModel>& info) {
  switch (info.param) {
    case DeformableModel::kMassSpring:
      return "MassSpring";
    case DeformableModel::kFiniteElements:
      return "FiniteElements";
    case DeformableModel::kShapeMatching:
      return "ShapeMatching";
  }
  return "Unknown";
}

INSTANTIATE_TEST_SUITE_P(Simulation, EveryModel,
                         ::testing::Values(DeformableModel::kMassSpring,
                                           DeformableModel::kFiniteElements,
                                           DeformableModel::kShapeMatching),
                         model_name);

SimulationSettings weightless() {
  SimulationSettings settings;
  settings.gravity = Vec3::Zero();
  return settings;
}

// What lies on the ground falls anew in every substep, and a response takes back a tenth of the
// depth: it sinks by 10 g h^2, which are 27 mm for the one substep that shape matching needs.
SimulationSettings on_ground() {
  SimulationSettings settings;
  settings.ground = Ground{};
  settings.substeps = 12;
  return settings;
}

double lowest_vertex(const Body& body, const NodeState& state) {
  std::vector<Vec3> vertices(body.shape->mesh.vertices.size());
  map_body(*body.shape, state.positions, vertices);
  double lowest = vertices[0].y();
  for (const Vec3& v : vertices) lowest = std::min(lowest, v.y());
  return lowest;
}

TEST_P(EveryModel, FallsFreelyInClosedForm) {
  const std::vector<Body> bodies{box_body("box")};
  const Vec3 start(1, 5, -2), velocity(0.5, 3, -1);
  Simulation simulation(bodies, {test::material_of(GetParam())}, {},
                        {moving(bodies[0], start, velocity)});
  constexpr int kOneSecond = 60;
  for (int i = 0; i < kOneSecond; ++i) simulation.advance();
  EXPECT_EQ(simulation.state().steps, 60u);
  // One second. The parabola is exact but for the rounding of some hundred substeps.
  const Vec3 gravity(0, -9.81, 0), at = start + velocity + 0.5 * gravity;
  const std::vector<Vec3> wanted = test::rest_nodes_at(*bodies[0].shape, at);
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    EXPECT_LE((simulation.state().bodies[0].positions[n] - wanted[n]).norm(), 1e-10);
    EXPECT_LE((simulation.state().bodies[0].velocities[n] - velocity - gravity).norm(), 1e-10);
  }
}

TEST_P(EveryModel, ComesToRestOnTheGround) {
  const std::vector<Body> bodies{box_body("box")};
  Simulation simulation(bodies, {test::material_of(GetParam())}, on_ground(),
                        {moving(bodies[0], {0, 0.2, 0}, Vec3::Zero())});  // 0.1 m to fall
  const double start = simulation.energy().total();
  double highest = start, fastest = 0.0;
  for (int i = 0; i < 180; ++i) {  // 3 s
    simulation.advance();
    highest = std::max(highest, simulation.energy().total());
    fastest = std::max(fastest, simulation.energy().kinetic);
  }
  EXPECT_LE(highest, 1.02 * start);
  EXPECT_GT(fastest, 0.8);  // of 0.98 J that the fall gives: it did fall
  // Root of the mean square over the mass of 1 kg, m/s.
  EXPECT_LE(std::sqrt(2.0 * simulation.energy().kinetic), 0.01);
  EXPECT_NEAR(lowest_vertex(bodies[0], simulation.state().bodies[0]), 0.0, 0.003);
}

TEST_P(EveryModel, LiesTenThousandStepsOnTheGround) {
  const std::vector<Body> bodies{box_body("box", {1, 1, 1})};
  Simulation simulation(bodies, {test::material_of(GetParam())}, on_ground(),
                        {moving(bodies[0], {0, 0.11, 0}, Vec3::Zero())});
  for (int i = 0; i < 10'000; ++i) ASSERT_NO_THROW(simulation.advance());
  const NodeState& end = simulation.state().bodies[0];
  for (std::size_t n = 0; n < end.positions.size(); ++n) {
    ASSERT_TRUE(end.positions[n].allFinite() && end.velocities[n].allFinite());
    EXPECT_LE(end.positions[n].norm(), 0.4);  // still where it was put
  }
  EXPECT_NEAR(lowest_vertex(bodies[0], end), 0.0, 0.003);
}

TEST(Simulation, BodyWithoutMaterialKeepsItsBits) {
  const std::vector<Body> bodies{box_body("falling"), box_body("fixed")};
  // The fixed one reaches into the ground, and the other falls on it.
  const std::vector<NodeState> start{moving(bodies[0], {0.03, 0.3, 0.01}, Vec3::Zero()),
                                     moving(bodies[1], {0, 0.05, 0}, Vec3::Zero())};
  test::BoxLoop loop(bodies, {test::springs(), std::nullopt}, on_ground(), start);
  loop.steps(9);
  EXPECT_GE(loop.contact_steps(), 3);
  // It was hit: 0.15 s of free fall from 0.2 m would end lower.
  EXPECT_GT(lowest_vertex(bodies[0], loop.state().bodies[0]), 0.2 - 0.5 * 9.81 * 0.0225 + 0.01);
  loop.steps(51);
  EXPECT_TRUE(test::same_bits({loop.state().bodies[1]}, {start[1]}));
}

TEST_P(EveryModel, ConservesMomentumWhenContactIsAnsweredAndHeld) {
  const std::vector<Body> bodies{box_body("a"), box_body("b")};
  Material light = test::material_of(GetParam());
  light.mass = 0.5;
  test::BoxLoop loop(bodies, {test::material_of(GetParam()), light}, weightless(),
                     {moving(bodies[0], {0, 0, 0}, {1, 0, 0}),
                      moving(bodies[1], {0.25, 0.07, 0.04}, {-1, 0.5, 0})});
  const Vec3 before = loop.simulation().momentum();
  EXPECT_LE((before - Vec3(0.5, 0.25, 0)).norm(), 1e-14);
  const double energy = loop.simulation().energy().total();
  bool held = false;
  for (int i = 0; i < 40; ++i) {
    loop.step();
    held = held || !loop.state().held.empty();
    EXPECT_LE((loop.simulation().momentum() - before).norm(), 1e-12) << "step " << i;
  }
  EXPECT_TRUE(held);
  EXPECT_GT(loop.contact_steps(), 0);
  // They hit one another: without an answer the first would keep its velocity of 1 m/s.
  const NodeState& a = loop.state().bodies[0];
  Vec3 sum = Vec3::Zero();
  for (const Vec3& velocity : a.velocities) sum += velocity;
  EXPECT_LT(sum.x() / static_cast<double>(a.velocities.size()), 0.6);
  EXPECT_LT(loop.simulation().energy().total(), energy);
}

// A box of one cell, 8 nodes of an eighth of the mass at the corners of a cube, turned, moved and
// turning: kinetic energy of the centre, and of 8 corners at half a space diagonal.
TEST_P(EveryModel, EnergyOfARigidlyMovedBodyIsInClosedForm) {
  const std::vector<Body> bodies{box_body("box", {1, 1, 1})};
  Material material = test::material_of(GetParam());
  material.mass = 3.0;
  const Mat3 turn = test::rotation_of(7, 1, -2, 3);
  const Vec3 centre(0.5, 2, -1), velocity(1, -2, 2), spin(0, 4, 3);
  NodeState state = moving(bodies[0], Vec3::Zero(), velocity);
  const double side = 2.0 * std::abs(state.positions[0].x());
  for (std::size_t n = 0; n < state.positions.size(); ++n) {
    const Vec3 arm = turn * state.positions[n];
    state.positions[n] = centre + arm;
    state.velocities[n] += spin.cross(arm);
  }
  const Simulation simulation(bodies, {material}, {}, {state});
  const Energy energy = simulation.energy();
  // A cube of corners has the moment of inertia m side^2 / 2 about every axis.
  EXPECT_NEAR(energy.kinetic, 0.5 * 3.0 * (9.0 + 25.0 * side * side / 2.0), 1e-12);
  EXPECT_NEAR(energy.potential, 3.0 * 9.81 * 2.0, 1e-12);
  EXPECT_NEAR(energy.elastic, 0.0, 1e-20);
  EXPECT_DOUBLE_EQ(energy.total(), energy.kinetic + energy.elastic + energy.potential);
  EXPECT_LE((simulation.momentum() - 3.0 * velocity).norm(), 1e-14);
}

// 12 edges, 12 diagonals of faces and 4 of space: their squared lengths add up to 48 sides squared.
TEST(Simulation, ElasticEnergyOfASwollenCubeIsInClosedForm) {
  const std::vector<Body> bodies{box_body("box", {1, 1, 1})};
  NodeState state = moving(bodies[0], Vec3::Zero(), Vec3::Zero());
  const double side = 2.0 * std::abs(state.positions[0].x());
  for (Vec3& p : state.positions) p *= 1.1;
  const Simulation simulation(bodies, {test::springs()}, {}, {state});
  const double wanted = 0.5 * 400.0 * 0.1 * 0.1 * 48.0 * side * side;
  EXPECT_NEAR(simulation.energy().elastic, wanted, 1e-12);
  EXPECT_EQ(simulation.energy().kinetic, 0.0);
}

TEST(Simulation, EnergyAndMomentumLeaveOutWhatCannotBeMoved) {
  const std::vector<Body> bodies{box_body("fixed")};
  const Simulation simulation(bodies, {std::nullopt}, {},
                              {moving(bodies[0], {0, 4, 0}, Vec3::Zero())});
  EXPECT_EQ(simulation.energy().total(), 0.0);
  EXPECT_EQ(simulation.momentum(), Vec3::Zero());
  EXPECT_EQ(simulation.substeps(), 1u);
}

}  // namespace
}  // namespace contactcheck
