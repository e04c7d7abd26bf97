// What a simulation refuses, and how it says that it came apart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/types/check.h"
#include "tests/core/dynamics/simulated_boxes.h"

namespace contactcheck {
namespace {

using test::box_body;
using test::moving;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StrEq;
using ::testing::ThrowsMessage;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Pair {
  std::vector<Body> bodies{box_body("good"), box_body("bad", {1, 1, 6})};
  std::vector<std::optional<Material>> materials{test::springs(), test::springs()};
  std::vector<NodeState> start{moving(bodies[0], Vec3::Zero(), Vec3::Zero()),
                               moving(bodies[1], Vec3::UnitX(), Vec3::Zero())};
};

TEST(Diverged, AStartThatIsNotFiniteNamesBodyNodeAndStep) {
  for (double value : {kNaN, kInfinity, -kInfinity, 1e300, -1e9})
    for (int k = 0; k < 3; ++k) {
      Pair fast, far;
      fast.start[1].velocities[5][k] = value;
      far.start[1].positions[5][k] = value;
      for (const Pair& pair : {fast, far})
        EXPECT_THAT(([&] { Simulation(pair.bodies, pair.materials, {}, pair.start); }),
                    ThrowsMessage<Diverged>(
                        StrEq("the simulation diverged: body \"bad\", node 5, step 0.")))
            << value << " in coordinate " << k;
    }
}

TEST(Diverged, FastButSaneStartsAreTaken) {
  Pair pair;
  pair.start[1].velocities[5].x() = 1e8;
  EXPECT_NO_THROW(Simulation(pair.bodies, pair.materials, {}, pair.start));
}

// The lowest node that a spring joins to `node`, or the node itself.
std::uint32_t lowest_neighbour(const Lattice& lattice, std::uint32_t node) {
  std::uint32_t lowest = node;
  for (const CornerIds& ids : lattice.cell_nodes)
    if (std::find(ids.begin(), ids.end(), node) != ids.end())
      lowest = std::min(lowest, *std::min_element(ids.begin(), ids.end()));
  return lowest;
}

// One substep carries a velocity over the springs of a node, and no farther.
TEST(Diverged, ALaterStepNamesBodyNodeAndStep) {
  Pair pair;
  pair.materials[1]->stiffness = 0.01;
  pair.materials[1]->damping = 0.0;
  pair.materials[0] = pair.materials[1];
  for (double value : {kNaN, 1e300}) {
    Simulation simulation(pair.bodies, pair.materials, {}, pair.start);
    ASSERT_EQ(simulation.substeps(), 1u);
    for (int i = 0; i < 3; ++i) simulation.advance();
    SimulationState state = simulation.state();
    const auto last = static_cast<std::uint32_t>(state.bodies[1].velocities.size() - 1);
    state.bodies[1].velocities[last].y() = value;
    simulation.restore(state);
    const std::uint32_t lowest = lowest_neighbour(*pair.bodies[1].shape->lattice, last);
    ASSERT_GT(lowest, 0u);
    EXPECT_THAT(([&] { simulation.advance(); }),
                ThrowsMessage<Diverged>(StrEq("the simulation diverged: body \"bad\", node " +
                                              std::to_string(lowest) + ", step 4.")))
        << value;
  }
}

TEST(Simulation, TooStiffForTheWantedSubstepsIsRefused) {
  Pair pair;
  pair.materials[1]->stiffness = 1e6;
  const std::uint32_t needed = Simulation(pair.bodies, pair.materials, {}, pair.start).substeps();
  ASSERT_GT(needed, 2u);
  SimulationSettings settings;
  settings.substeps = needed;
  EXPECT_EQ(Simulation(pair.bodies, pair.materials, settings, pair.start).substeps(), needed);
  settings.substeps = needed + 7;
  EXPECT_EQ(Simulation(pair.bodies, pair.materials, settings, pair.start).substeps(), needed + 7);
  settings.substeps = needed - 1;
  EXPECT_THAT(([&] { Simulation(pair.bodies, pair.materials, settings, pair.start); }),
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("body \"bad\" is too stiff"), HasSubstr("longest stable step"))));
}

TEST(Simulation, TooStiffForTenThousandSubstepsIsRefused) {
  Pair pair;
  pair.materials[1]->stiffness = 1e16;
  EXPECT_THAT(([&] { Simulation(pair.bodies, pair.materials, {}, pair.start); }),
              ThrowsMessage<InputError>(HasSubstr("body \"bad\" is too stiff")));
}

// The stiffest body sets the pace of all: what holds contacts between bodies needs one clock.
TEST(Simulation, TheShortestStableStepCountsWhateverTheOrderOfBodies) {
  Pair pair;
  pair.materials[0]->stiffness = 1e5;
  const std::uint32_t first = Simulation(pair.bodies, pair.materials, {}, pair.start).substeps();
  std::swap(pair.bodies[0], pair.bodies[1]);
  std::swap(pair.materials[0], pair.materials[1]);
  std::swap(pair.start[0], pair.start[1]);
  EXPECT_EQ(Simulation(pair.bodies, pair.materials, {}, pair.start).substeps(), first);
  EXPECT_GT(first, 1u);
}

}  // namespace
}  // namespace contactcheck
