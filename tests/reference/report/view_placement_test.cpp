#include "reference/report/formats/view_bytes.h"

#include <gtest/gtest.h>

namespace contactcheck::report {
namespace {

TEST(Placement, OfAnOrdinarySceneIsOneForAllFrames) {
  const std::vector<Placement> placements =
      view_placements({{{{0, 0, 0}, {1, 2, 6}}}, {{{0, 0, 0}, {1, 2, 4}}}});
  ASSERT_EQ(placements.size(), 1u);
  EXPECT_EQ(placements[0].origin, Vec3(0.5, 1, 3));
  EXPECT_EQ(placements[0].scale, 4.0);
  EXPECT_EQ(placements[0].in_view({1, 2, 6}), Vec3(0.125, 0.25, 0.75));
}

TEST(Placement, OfFramesThatDifferTooMuchInSizeIsOneEach) {
  const std::vector<Placement> placements =
      view_placements({{{{0, 0, 0}, {2, 2, 2}}}, {{{0, 0, 0}, {1e-3, 0, 0}}}});
  ASSERT_EQ(placements.size(), 2u);
  EXPECT_EQ(placements[1].origin, Vec3(5e-4, 0, 0));
  EXPECT_EQ(placements[1].scale, 0x1p-10);
}

TEST(Placement, FarFromTheOriginKeepsWhatSinglesWouldLose) {
  const std::vector<Placement> placements = view_placements({{{{1e9, 0, 0}, {1e9 + 1, 0, 0}}}});
  EXPECT_EQ(placements[0].in_view({1e9 + 0.25, 0, 0}), Vec3(-0.25, 0, 0));
}

TEST(Placement, OfTheLargestAndTheSmallestDoublesIsFinite) {
  for (double size : {1.7e308, 5e-324}) {
    const std::vector<Placement> placements = view_placements({{{{-size, 0, 0}, {size, 0, 0}}}});
    const Vec3 p = placements[0].in_view({size, 0, 0});
    EXPECT_TRUE(p.allFinite()) << size;
    EXPECT_GT(p.x(), 0.0) << size;
    EXPECT_LE(p.x(), 2.0) << size;
  }
}

TEST(Placement, OfASinglePointIsThere) {
  const std::vector<Placement> placements = view_placements({{{{3, 4, 5}}}});
  EXPECT_EQ(placements[0].in_view({3, 4, 5}), Vec3(0, 0, 0));
}

TEST(Placement, OfNoFrameIsTheOrigin) { EXPECT_EQ(view_placements({}).size(), 1u); }

}  // namespace
}  // namespace contactcheck::report
