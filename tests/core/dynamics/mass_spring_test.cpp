#include "core/dynamics/mass_spring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/core/dynamics/model_states.h"

namespace contactcheck {
namespace {

// Nodes that share a cell are the pairs that differ by at most one grid line per axis and have a
// kept cell between them.
std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_by_brute_force(const Lattice& lattice) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto has = [](const CornerIds& ids, std::uint32_t n) {
    return std::find(ids.begin(), ids.end(), n) != ids.end();
  };
  for (std::uint32_t a = 0; a < lattice.nodes.size(); ++a)
    for (std::uint32_t b = a + 1; b < lattice.nodes.size(); ++b)
      if (std::any_of(lattice.cell_nodes.begin(), lattice.cell_nodes.end(),
                      [&](const CornerIds& ids) { return has(ids, a) && has(ids, b); }))
        pairs.insert({a, b});
  return pairs;
}

TEST(LatticeSprings, OfOneCellAreEdgesAndDiagonals) {
  const auto shape = make_shape(test::unit_box_mesh(1), {1, 1, 1}, 0.5);  // a cell of side 2
  std::array<int, 4> by_square{};
  for (const Spring& s : lattice_springs(*shape->lattice)) {
    const int square = static_cast<int>(s.rest_length * s.rest_length / 4.0 + 0.5);
    EXPECT_DOUBLE_EQ(s.rest_length, 2.0 * std::sqrt(square));
    ++by_square.at(static_cast<std::size_t>(square));
  }
  EXPECT_EQ(by_square, (std::array<int, 4>{0, 12, 12, 4}));
}

TEST(LatticeSprings, JoinEveryPairOfACellOnce) {
  // A hollow sphere: cells at the inside are not kept.
  const auto shape = make_shape(test::sphere_mesh({1, 2, 3}, 1.0, 3), {6, 6, 6});
  const Lattice& lattice = *shape->lattice;
  ASSERT_LT(lattice.cells.size(), 200u);
  std::set<std::pair<std::uint32_t, std::uint32_t>> joined;
  for (const Spring& s : lattice_springs(lattice)) {
    EXPECT_TRUE(joined.insert({s.a, s.b}).second);
    EXPECT_DOUBLE_EQ(s.rest_length, (lattice.rest_node(s.a) - lattice.rest_node(s.b)).norm());
  }
  EXPECT_EQ(joined, pairs_by_brute_force(lattice));
}

TEST(MassSpring, ForceIsMinusTheGradientOfTheEnergy) {
  const auto shape = test::block_shape();
  const MassSpring model(*shape->lattice, Material{});
  const NodeState state = test::disturbed(*shape, 0.1);
  // Newtons; the forces are tens of newtons, the differences good to the square of the step.
  EXPECT_LT(test::worst_gradient_error(model, state.positions, 1e-5), 1e-4);
  EXPECT_GT(model.elastic_energy(state.positions), 1.0);
}

TEST(MassSpring, SpringForceIsStiffnessTimesStretchPlusDampingTimesRate) {
  const auto shape = make_shape(test::unit_box_mesh(1), {1, 1, 1}, 0.5);
  Material material;
  material.stiffness = 100.0;
  material.damping = 3.0;
  const MassSpring model(*shape->lattice, material);
  // All nodes in one point but the last, 5 m from it: 7 springs pull there, each along x.
  std::vector<Vec3> positions(8, Vec3(1, 1, 1)), velocities(8, Vec3::Zero());
  std::vector<Vec3> forces(8, Vec3::Zero());
  positions[7].x() += 5.0;
  velocities[7] = Vec3(0.5, 7.0, -9.0);  // only what is along the spring is damped
  model.add_forces(positions, velocities, forces);
  const double rest_lengths = 3 * 2.0 + 3 * std::sqrt(8.0) + std::sqrt(12.0);
  EXPECT_NEAR(forces[7].x(), -(100.0 * (7 * 5.0 - rest_lengths) + 3.0 * 7 * 0.5), 1e-10);
  EXPECT_EQ(forces[7].y(), 0.0);
  EXPECT_EQ(forces[7].z(), 0.0);
}

TEST(MassSpring, SpringOfLengthZeroGivesNoForce) {
  const auto shape = test::block_shape();
  const MassSpring model(*shape->lattice, Material{});
  const std::size_t n = shape->lattice->nodes.size();
  const std::vector<Vec3> positions(n, Vec3(3, 4, 5)), velocities(n, Vec3(1, 0, 0));
  std::vector<Vec3> forces(n, Vec3::Zero());
  model.add_forces(positions, velocities, forces);
  for (const Vec3& f : forces) EXPECT_EQ(f, Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace contactcheck
