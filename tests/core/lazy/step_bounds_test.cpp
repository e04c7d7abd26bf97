// Bounds over a step hold both ends, and by how much of their slacks, on every instruction set.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/lazy/bounds_cases.h"
#include "tests/core/lazy/one_step.h"

namespace contactcheck {
namespace {

using test::kSixteenth;
using test::NamedShape;
using test::OneStep;
using test::TriangleSource;

TEST(StepBounds, HoldBothEnds) {
  for (const NamedShape& named : test::shapes())
    for (const std::string& isa : lazy_isas())
      EXPECT_EQ(test::broken_step(lazy_kernels(isa), named.shape, 8), "")
          << named.name << " " << isa;
}

TEST(StepBounds, BodiesMeetUnlessBoxesAreOnTheSameSideAtBothEnds) {
  const test::BodyMeetings seen = test::judged_meetings(4000);
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_GT(seen.apart, 500);
  EXPECT_LT(seen.apart, 3500);
}

template <typename Error>
double largest_on_all(Error&& error) {
  double largest = 0.0;
  for (const std::string& isa : lazy_isas()) largest = std::max(largest, error(lazy_kernels(isa)));
  return largest;
}

TEST(StepBounds, SlackOfBoxesIsUsed) {
  for (const double place : {0.0, 1e12})
    test::report_observed_error(
        place == 0.0 ? "slack of boxes over a step" : "slack of boxes over a step, far out",
        largest_on_all([&](const LazyKernels& kernels) {
          return test::largest_step_box_error(kernels, place);
        }),
        kSixteenth);
}

// Loose by proof, as that of one frame (state_slack_test.cpp).
TEST(StepBounds, SlackOfSlabsHolds) {
  test::report_observed_error("slack of slabs over a step",
                              largest_on_all(test::largest_step_slab_error), 0.002);
}

// The frame moves with the body: its bounds are hardly wider than those of a body at rest.
TEST(StepBounds, AreNotDrawnOutByMotionThatDoesNotTurn) {
  TriangleSource random(546);
  for (const NamedShape& named : test::shapes())
    for (const bool from_vertices : {false, true}) {
      OneStep still(named.shape, from_vertices), moving(named.shape, from_vertices);
      const std::vector<Vec3> nodes = test::deformed_nodes(*named.shape, {0.1}, random);
      std::vector<Vec3> later = nodes;
      for (Vec3& n : later) n += Vec3(1000, -500, 40);
      still.begin(nodes, nodes, lazy_kernels());
      moving.begin(nodes, later, lazy_kernels());
      EXPECT_EQ(moving.start().scale, still.start().scale);
      for (std::uint32_t b = 0; b < still.start().tree->blocks.size(); ++b)
        for (std::uint32_t c = 0; c < still.start().tree->blocks[b].children; ++c)
          for (int k = 0; k < 3; ++k) {
            const LaneBoxes& a = still.start().blocks.find(b)->box;
            const LaneBoxes& m = moving.start().blocks.find(b)->box;
            ASSERT_NEAR(a.lo[k][c], m.lo[k][c], 2.0 * still.start().slack) << named.name;
            ASSERT_NEAR(a.hi[k][c], m.hi[k][c], 2.0 * still.start().slack) << named.name;
          }
    }
}

}  // namespace
}  // namespace contactcheck
