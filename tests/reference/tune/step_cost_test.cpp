#include "reference/tune/step_cost.h"

#include <gmock/gmock.h>

#include "tests/reference/scene/installed.h"
#include "tests/reference/tune/falling_scene.h"

namespace contactcheck {
namespace {

using ::testing::Each;
using ::testing::Gt;

// Some hundred times the work of a step can be told apart on any machine.
TEST(StepCost, OfManySubstepsIsHigherThanOfFew) {
  const test::Scratch scratch;
  const Scene few = load_scene(scratch.write("few.json", test::falling_scene()));
  Scene many = few;
  many.simulation->settings.substeps = 500;
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  StepCostSettings settings;
  settings.steps = 3;
  std::size_t steps = 0;
  const std::vector<double> costs =
      step_costs({few, many}, catalog, settings, [&](std::size_t) { ++steps; });
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_THAT(costs, Each(Gt(0.0)));
  EXPECT_GT(costs[1], 10.0 * costs[0]);
  EXPECT_GT(steps, 6u);
}

}  // namespace
}  // namespace contactcheck
