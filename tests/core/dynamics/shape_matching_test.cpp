#include "core/dynamics/shape_matching.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/dynamics/model_states.h"

namespace contactcheck {
namespace {

Material jelly_of_regions(std::uint32_t region) {
  Material material;
  material.model = DeformableModel::kShapeMatching;
  material.relaxation_time = 0.05;
  material.region = region;
  return material;
}

Vec3 center_of_mass(std::span<const double> masses, const std::vector<Vec3>& positions) {
  Vec3 moment = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t n = 0; n < masses.size(); ++n) {
    moment += masses[n] * positions[n];
    mass += masses[n];
  }
  return moment / mass;
}

TEST(ShapeMatching, HasOneRegionPerCellOrOneForAll) {
  const auto shape = test::block_shape();
  const Lattice& lattice = *shape->lattice;
  EXPECT_EQ(ShapeMatching(lattice, jelly_of_regions(0)).region_count(), 1u);
  EXPECT_EQ(ShapeMatching(lattice, jelly_of_regions(1)).region_count(), 24u);
}

TEST(ShapeMatching, WideRegionsAreTheWholeBody) {
  // Every cell reaches every other within 3 steps: 24 equal regions move nodes as one does.
  const auto shape = test::block_shape();
  const NodeState start = test::disturbed(*shape, 0.1);
  NodeState one = start, many = start;
  const ShapeMatching whole(*shape->lattice, jelly_of_regions(0)),
      wide(*shape->lattice, jelly_of_regions(3));
  for (int i = 0; i < 20; ++i) {
    whole.step(0.01, Vec3::Zero(), one);
    wide.step(0.01, Vec3::Zero(), many);
  }
  for (std::size_t n = 0; n < one.positions.size(); ++n)
    EXPECT_LT((one.positions[n] - many.positions[n]).norm(), 1e-12);
  EXPECT_NEAR(whole.elastic_energy(one.positions) / wide.elastic_energy(one.positions), 1.0, 1e-12);
}

TEST(ShapeMatching, NodesGoToTheirGoalsAsACriticallyDampedOscillator) {
  // A uniformly blown-up body: all goals stand still, the way to them shrinks by the closed form.
  const auto shape = test::block_shape();
  const ShapeMatching model(*shape->lattice, jelly_of_regions(0));
  const std::vector<Vec3> rest = shape->lattice->rest_nodes();
  const Vec3 center = center_of_mass(model.masses(), rest);
  for (int steps : {200, 2000}) {
    NodeState state = test::at_rest(*shape);
    for (Vec3& p : state.positions) p = center + 1.3 * (p - center);
    const double t = 0.1;  // two time constants
    for (int i = 0; i < steps; ++i) model.step(t / steps, Vec3::Zero(), state);
    const double expected = 0.3 * (1.0 + 2.0) * std::exp(-2.0);
    const double grown = (state.positions[0] - center).norm() / (rest[0] - center).norm() - 1.0;
    // The scheme is of first order: ten times the steps, a tenth of the error.
    EXPECT_NEAR(grown, expected, 0.5 / steps) << steps;
  }
}

TEST(ShapeMatching, EveryStepIsStable) {
  const auto shape = test::block_shape();
  for (std::uint32_t region : {0u, 1u})
    for (double dt : {1e-6, 1e-3, 0.05, 1.0, 1000.0}) {
      const ShapeMatching model(*shape->lattice, jelly_of_regions(region));
      NodeState state = test::disturbed(*shape, 0.3);  // a whole cell: some are inside out
      const Vec3 center = center_of_mass(model.masses(), state.positions);
      for (int i = 0; i < 500; ++i) model.step(dt, Vec3::Zero(), state);
      for (const Vec3& p : state.positions) EXPECT_LT((p - center).norm(), 2.0) << dt;
    }
}

TEST(ShapeMatching, DriftingBodyKeepsItsShapeNearToTheBit) {
  // 1,000 steps of two additions each, at up to 64 m: an ulp per addition and axis, twice for
  // the kicks that answer the rounding of the goals.
  constexpr double kAdded = 2 * 2000 * 0x1p-47;
  const auto shape = test::block_shape();
  for (std::uint32_t region : {0u, 1u}) {
    const ShapeMatching model(*shape->lattice, jelly_of_regions(region));
    NodeState state = test::at_rest(*shape);
    for (Vec3& v : state.velocities) v = Vec3(1.25, -2.5, 0.75);
    for (int i = 0; i < 1000; ++i) model.step(1.0 / 64, Vec3::Zero(), state);
    const Vec3 offset = Vec3(1.25, -2.5, 0.75) * (1000.0 / 64);
    const std::vector<Vec3> rest = shape->lattice->rest_nodes();
    for (std::size_t n = 0; n < rest.size(); ++n)
      EXPECT_LT((state.positions[n] - rest[n] - offset).norm(), kAdded);
  }
}

TEST(ShapeMatching, RotatingBodyKeepsItsShapeUpToTheCentrifugalStretch) {
  const auto shape = test::block_shape();
  constexpr double kRate = 2.0;  // rad/s
  for (std::uint32_t region : {0u, 1u}) {
    const ShapeMatching model(*shape->lattice, jelly_of_regions(region));
    const std::vector<Vec3> rest = shape->lattice->rest_nodes();
    const Vec3 center = center_of_mass(model.masses(), rest);
    NodeState state = test::at_rest(*shape);
    for (std::size_t n = 0; n < rest.size(); ++n)
      state.velocities[n] = Vec3(0, 0, kRate).cross(rest[n] - center);
    for (int i = 0; i < 600; ++i) model.step(0.005, Vec3::Zero(), state);
    // One region: the stretch across the axis is (rate * tau)^2 = 1 %, nothing along it. With
    // small regions a cell sees little of a strain, so that the body gives way more.
    const double most = region == 0 ? 0.011 : 0.1;
    double across = 0.0;
    for (std::size_t n = 0; n < rest.size(); ++n) {
      const Vec3 before = rest[n] - center, after = state.positions[n] - center;
      const double stretch = after.head<2>().norm() / before.head<2>().norm() - 1.0;
      EXPECT_LT(std::abs(stretch), most);
      EXPECT_NEAR(after.z(), before.z(), region == 0 ? 1e-12 : 0.02);
      across = std::max(across, stretch);
    }
    EXPECT_GT(across, 0.009);
    // Slowed by no more than the stretch asks (angular momentum stays): about 6 rad in 3 s.
    const Vec3 a = rest[0] - center, b = state.positions[0] - center;
    const double turned = std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    const double expected = 3.0 * kRate - 2.0 * std::acos(-1.0);
    EXPECT_NEAR(turned, expected, 3.0 * kRate * 2.0 * most);
  }
}

// Two prongs of 4 cells on a bridge of 3, one cell apart. Only the mesh of the bridge and the
// prongs makes the lattice keep exactly these cells.
std::shared_ptr<const BodyShape> fork_shape() {
  TriangleMesh mesh;
  const auto add = [&mesh](const Vec3& lo, const Vec3& hi) {
    const TriangleMesh box = test::box_mesh(lo, hi, 8);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), box.vertices.begin(), box.vertices.end());
    for (const Triangle& t : box.triangles)
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  add({0, 0, 0}, {3, 0.9, 1});
  add({0, 0, 0}, {0.9, 5, 1});
  add({2.1, 0, 0}, {3, 5, 1});
  return make_shape(mesh, {3, 5, 1}, 0.002);
}

TEST(ShapeMatching, RegionsDoNotReachAcrossAGap) {
  const auto shape = fork_shape();
  const Lattice& lattice = *shape->lattice;
  ASSERT_EQ(lattice.cells.size(), 11u);
  const ShapeMatching model(lattice, jelly_of_regions(2));  // wide enough to reach over the gap
  NodeState state = test::at_rest(*shape);
  for (std::uint32_t n = 0; n < lattice.nodes.size(); ++n)
    if (lattice.nodes[n][1] == 5 && lattice.nodes[n][0] <= 1) state.positions[n].z() += 0.3;
  model.step(0.01, Vec3::Zero(), state);
  double near = 0.0;
  for (std::uint32_t n = 0; n < lattice.nodes.size(); ++n) {
    if (lattice.nodes[n][1] < 4) continue;
    if (lattice.nodes[n][0] >= 2)
      EXPECT_LT(state.velocities[n].norm(), 1e-12);
    else
      near = std::max(near, state.velocities[n].norm());
  }
  EXPECT_GT(near, 0.01);
}

}  // namespace
}  // namespace contactcheck
