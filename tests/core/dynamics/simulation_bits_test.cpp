// The same bits for every run, thread count and restart.
#include <gtest/gtest.h>

#include "core/types/hash.h"
#include "tests/core/dynamics/simulated_boxes.h"

namespace contactcheck {
namespace {

using test::box_body;
using test::BoxLoop;
using test::moving;

// Two boxes that fall on one another and on the ground, and one of every other model beside them.
class FallingBoxes : public ::testing::Test {
 protected:
  BoxLoop loop(std::uint32_t threads) const {
    SimulationSettings settings;
    settings.ground = Ground{};
    settings.threads = threads;
    return BoxLoop(
        bodies_,
        {test::springs(), test::springs(), test::material_of(DeformableModel::kFiniteElements),
         test::material_of(DeformableModel::kShapeMatching)},
        settings,
        {moving(bodies_[0], {0, 0.12, 0}, Vec3::Zero()),
         moving(bodies_[1], {0.05, 0.37, 0.03}, {0, -1, 0.25}),
         moving(bodies_[2], {1, 0.15, 0}, {0.5, 0, 0}),
         moving(bodies_[3], {2, 0.15, 0}, {0, 0, 0.5})});
  }

  const std::vector<Body> bodies_{box_body("a"), box_body("b"), box_body("c"), box_body("d")};
};

constexpr int kSteps = 40;

TEST_F(FallingBoxes, TwoRunsGiveTheSameBits) {
  BoxLoop first = loop(1), second = loop(1);
  first.steps(kSteps);
  second.steps(kSteps);
  EXPECT_GT(first.contact_steps(), 10);
  EXPECT_TRUE(test::same_bits(first.state().bodies, second.state().bodies));
  // The comparison can tell two states apart.
  second.step();
  EXPECT_FALSE(test::same_bits(first.state().bodies, second.state().bodies));
}

// Measured once, with g++ 12 in Release. Every compiler, build type and sanitizer has to agree: a
// compiler that reorders or fuses shows here.
TEST_F(FallingBoxes, GiveTheSameBitsInEveryBuild) {
  BoxLoop boxes = loop(1);
  boxes.steps(kSteps);
  const std::vector<std::uint64_t> expected = {4173690717242398166u, 14488916752495615520u,
                                               8918930323077863192u, 18404930371421482063u};
  for (std::size_t b = 0; b < expected.size(); ++b) {
    Fnv1a hash;
    for (const Vec3& p : boxes.state().bodies[b].positions)
      hash.bytes(p.data(), 3 * sizeof(double));
    for (const Vec3& v : boxes.state().bodies[b].velocities)
      hash.bytes(v.data(), 3 * sizeof(double));
    EXPECT_EQ(hash.digest(), expected[b]) << "body " << b;
  }
}

TEST_F(FallingBoxes, TwoThreadsGiveTheSameBitsAsOne) {
  BoxLoop one = loop(1), two = loop(2);
  for (int i = 0; i < kSteps; ++i) {
    one.step();
    two.step();
    ASSERT_TRUE(test::same_bits(one.state().bodies, two.state().bodies)) << "step " << i;
  }
  EXPECT_GT(one.contact_steps(), 10);
}

// With contacts held from the step before: without them the next step would be another.
TEST_F(FallingBoxes, GoOnFromARestoredStateWithTheSameBits) {
  BoxLoop through = loop(1);
  while (through.state().held.empty()) {
    through.step();
    ASSERT_LT(through.state().steps, 60u) << "the boxes never met";
  }
  const SimulationState middle = through.state();
  through.steps(kSteps);
  const SimulationState end = through.state();

  through.simulation().restore(middle);
  EXPECT_EQ(through.state().steps, middle.steps);
  through.steps(kSteps);
  EXPECT_TRUE(test::same_bits(through.state().bodies, end.bodies));
  EXPECT_EQ(through.state().steps, end.steps);

  BoxLoop fresh = loop(2);
  fresh.simulation().restore(middle);
  fresh.steps(kSteps);
  EXPECT_TRUE(test::same_bits(fresh.state().bodies, end.bodies));
}

TEST_F(FallingBoxes, AStateIsMoreThanItsNodes) {
  BoxLoop loop_with = loop(1), loop_without = loop(1);
  while (loop_with.state().held.empty()) {
    loop_with.step();
    ASSERT_LT(loop_with.state().steps, 60u) << "the boxes never met";
  }
  loop_without.simulation().restore({loop_with.state().bodies, {}, loop_with.state().steps});
  loop_with.simulation().advance();
  loop_without.simulation().advance();
  EXPECT_FALSE(test::same_bits(loop_with.state().bodies, loop_without.state().bodies));
}

}  // namespace
}  // namespace contactcheck
