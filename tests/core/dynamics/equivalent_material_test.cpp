#include "core/dynamics/equivalent_material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/dynamics/model_states.h"

namespace contactcheck {
namespace {

constexpr DeformableModel kModels[] = {DeformableModel::kMassSpring,
                                       DeformableModel::kFiniteElements,
                                       DeformableModel::kShapeMatching};

Material jelly(DeformableModel model) {
  Material material;
  material.model = model;
  material.mass = 7.0;
  material.restitution = 0.1;
  material.friction = 0.9;
  material.damping_time = 0.004;
  material.damping = 3.0;
  material.region = 2;
  return material;
}

// A whole block of cells of 0.1 m, with those inside that hold no surface.
BodyShape solid_block(std::uint32_t side) {
  Lattice lattice;
  for (auto& line : lattice.lines)
    for (std::uint32_t i = 0; i <= side; ++i) line.push_back(0.1 * i);
  const std::uint32_t along = side + 1;
  for (std::uint32_t z = 0; z <= side; ++z)
    for (std::uint32_t y = 0; y <= side; ++y)
      for (std::uint32_t x = 0; x <= side; ++x) {
        lattice.nodes.push_back({x, y, z});
        if (x == side || y == side || z == side) continue;
        lattice.cells.push_back({x, y, z});
        CornerIds ids;
        for (std::uint32_t c = 0; c < 8; ++c)
          ids[c] = (x + c % 2) + along * (y + c / 2 % 2) + along * along * (z + c / 4);
        lattice.cell_nodes.push_back(ids);
      }
  BodyShape shape;
  shape.lattice = lattice;
  return shape;
}

// Seconds from the greatest stretch along x to the next one.
double period(const Material& material, const BodyShape& shape) {
  const auto body = make_deformable(shape, material);
  NodeState state = test::at_rest(shape);
  for (Vec3& p : state.positions) p.x() *= 1.01;
  const double dt = std::min(1e-4, body->stable_step());
  const auto rate = [&] {
    double sum = 0.0;
    for (std::size_t n = 0; n < state.positions.size(); ++n)
      sum += body->masses()[n] * (state.positions[n].x() - 0.2) * state.velocities[n].x();
    return sum;
  };
  double time = 0.0;
  for (bool inwards = false; time < 10.0; time += dt) {
    body->step(dt, Vec3::Zero(), state);
    if (inwards && rate() > 0.0) return 2.0 * time;  // half of it is over
    inwards |= rate() < 0.0;
  }
  return time;
}

TEST(EquivalentMaterial, KeepsWhatIsNotTheModels) {
  const auto shape = test::block_shape();
  for (const DeformableModel from : kModels)
    for (const DeformableModel to : kModels) {
      const Material material = jelly(from), other = equivalent_material(material, to, *shape);
      EXPECT_EQ(other.model, to);
      EXPECT_EQ(other.mass, 7.0);
      EXPECT_EQ(other.restitution, 0.1);
      EXPECT_EQ(other.friction, 0.9);
      EXPECT_EQ(other.region, from == to ? 2u : 1u);
    }
}

TEST(EquivalentMaterial, ThereAndBackIsTheSameStiffness) {
  const auto shape = test::block_shape();
  Material springs = jelly(DeformableModel::kMassSpring);
  springs.stiffness = 321.0;
  for (const DeformableModel model : {kModels[1], kModels[2]}) {
    const Material back = equivalent_material(equivalent_material(springs, model, *shape),
                                              DeformableModel::kMassSpring, *shape);
    EXPECT_NEAR(back.stiffness, 321.0, 0.5);
    if (model == DeformableModel::kFiniteElements) {
      EXPECT_NEAR(back.damping, 3.0, 0.01);
    }
  }
}

// Per node 3 edges, 6 face and 4 body diagonals: C11 = 13/3 and C12 = C44 = 7/3 stiffness / edge,
// by Voigt's average E = 4.5 stiffness / edge. A block's outer springs make it a little stiffer.
TEST(EquivalentMaterial, OfSpringsInALargeBlockIsTheSolidThatTheyAreOnAverage) {
  Material springs = jelly(DeformableModel::kMassSpring);
  const Material solid =
      equivalent_material(springs, DeformableModel::kFiniteElements, solid_block(16));
  EXPECT_EQ(solid.poisson_ratio, 0.25);
  EXPECT_NEAR(solid.youngs_modulus / (4.5 * springs.stiffness / 0.1), 1.04, 0.04);
  EXPECT_EQ(solid.damping_time, springs.damping / springs.stiffness);
}

// Shape matching is damped critically, and does not swing.
TEST(EquivalentMaterial, OfSpringsSwingsAsFastAsFiniteElements) {
  const BodyShape shape = solid_block(4);
  Material springs = jelly(DeformableModel::kMassSpring);
  springs.damping = 0.0;
  const double wanted = period(springs, shape);
  EXPECT_LT(wanted, 1.0);
  const Material solid = equivalent_material(springs, DeformableModel::kFiniteElements, shape);
  EXPECT_NEAR(period(solid, shape) / wanted, 1.0, 0.15);
}

}  // namespace
}  // namespace contactcheck
