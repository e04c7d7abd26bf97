#include "reference/tune/simulated_models.h"

#include <gmock/gmock.h>

#include "tests/reference/scene/installed.h"
#include "tests/reference/tune/falling_scene.h"

namespace contactcheck::tune {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::Gt;

// Some hundred times the work of a step can be told apart on any machine.
TEST(StepCost, OfManySubstepsIsHigherThanOfFew) {
  const test::Scratch scratch;
  const scene::Scene few = scene::load_scene(scratch.write("few.json", test::falling_scene()));
  scene::Scene many = few;
  many.simulation()->settings.substeps = 500;
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  StepCostSettings settings;
  settings.steps = 3;
  std::size_t steps = 0;
  const std::vector<Cost> costs =
      step_costs({few, many}, catalog, settings, [&](std::size_t) { ++steps; });
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_THAT(costs, Each(Field(&Cost::ms, Gt(0.0))));
  EXPECT_GT(costs[1].ms, 10.0 * costs[0].ms);
  EXPECT_GT(steps, 6u);
}

// A clock on which the first scene's step takes 1 ms and the second's 3 ms; which becomes twice as
// slow from repeat to repeat, while the first scene is preempted in the first two of five.
class MadeUpClock {
 public:
  explicit MadeUpClock(std::size_t states) : states_(states) {}

  double now_ms() {
    const std::size_t piece = calls_ / 2, repeat = piece / (2 * states_);
    const bool second = (piece + repeat) % 2 == 1, ends = calls_++ % 2 == 1;
    if (ends) now_ += (second ? 3.0 : 1.0) * static_cast<double>(1u << repeat);
    if (ends && !second && repeat < 2) now_ += 1000.0;
    return now_;
  }

 private:
  std::size_t states_, calls_ = 0;
  double now_ = 0.0;
};

TEST(StepCost, IsToldFromTheFirstScenesOnAMachineThatSlowsDown) {
  const test::Scratch scratch;
  const scene::Scene scene =
      scene::load_scene(scratch.write("falling.json", test::falling_scene()));
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  StepCostSettings settings;
  settings.steps = 2;
  MadeUpClock clock(settings.steps);
  settings.now_ms = [&] { return clock.now_ms(); };
  const std::vector<Cost> costs = step_costs({scene, scene}, catalog, settings, [](std::size_t) {});
  EXPECT_NEAR(costs[1].ms, 3.0 * costs[0].ms, 1e-9);
  EXPECT_EQ(costs[0].low_ms, costs[0].high_ms) << "the unit";
  EXPECT_LT(costs[1].low_ms, costs[1].ms) << "two pairs of five were spoiled";
}

}  // namespace
}  // namespace contactcheck::tune
