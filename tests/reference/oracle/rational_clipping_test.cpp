// The quick rational test against the linear program: two ways that share no line of code.

#include "reference/oracle/rational_clipping.h"

#include <gtest/gtest.h>

#include "tests/support/random_triangles.h"
#include "tests/support/range_ends.h"

namespace contactcheck::test {
namespace {

using oracle::rational::TriangleCorners;

const TriangleCorners kBase = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

bool meets_base(const TriangleCorners& t) {
  const bool meets = oracle::rational::triangles_intersect_by_clipping(kBase, t);
  EXPECT_EQ(oracle::rational::triangles_intersect_by_clipping(t, kBase), meets);
  return meets;
}

TEST(RationalClipping, KnownAnswersOfProperTriangles) {
  EXPECT_TRUE(meets_base(kBase));
  EXPECT_TRUE(meets_base({Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 1)}));
  EXPECT_TRUE(meets_base({Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)}));
  EXPECT_TRUE(meets_base({Vec3(1, 1, 0), Vec3(1.5, 1, 0), Vec3(1, 1.5, 0)}));
  EXPECT_FALSE(meets_base({Vec3(3, 3, 0), Vec3(5, 3, 0), Vec3(3, 5, 0)}));
  EXPECT_FALSE(meets_base({Vec3(1, 1, 5e-324), Vec3(2, 1, 1), Vec3(1, 2, 1)}));
}

TEST(RationalClipping, KnownAnswersOfSegmentsAndPoints) {
  EXPECT_TRUE(meets_base({Vec3(2, 2, 0), Vec3(2, 2, 0), Vec3(2, 2, 0)}));
  EXPECT_FALSE(meets_base({Vec3(2, 2, 5e-324), Vec3(2, 2, 5e-324), Vec3(2, 2, 5e-324)}));
  EXPECT_TRUE(meets_base({Vec3(-1, 5, 0), Vec3(5, -1, 0), Vec3(2, 2, 0)}));
  EXPECT_FALSE(meets_base({Vec3(-1, 6, 0), Vec3(6, -1, 0), Vec3(6, -1, 0)}));
  const TriangleCorners zero = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  EXPECT_TRUE(oracle::rational::triangles_intersect_by_clipping(zero, zero));
  EXPECT_TRUE(oracle::rational::triangles_intersect_by_clipping(
      {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0, 0)},
      {Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(1, 0, 0)}));
  EXPECT_FALSE(oracle::rational::triangles_intersect_by_clipping(
      {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0, 0)},
      {Vec3(3, 0, 0), Vec3(4, 0, 0), Vec3(3, 0, 0)}));
}

/// Both ways on every pair; gives back how many touch.
template <typename MakePair>
int compare(int count, MakePair make_pair) {
  int touching = 0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const auto [p, q] = make_pair();
    const bool truth = oracle::rational::triangles_intersect(p, q);
    EXPECT_EQ(oracle::rational::triangles_intersect_by_clipping(p, q), truth) << i;
    EXPECT_EQ(oracle::rational::triangles_intersect_by_clipping(q, p), truth) << i << ", swapped";
    touching += truth;
  }
  return touching;
}

TEST(RationalClipping, AgreesWithTheLinearProgramOnSmallGrids) {
  TriangleSource source(61);
  const int touching =
      compare(30000, [&] { return std::pair(source.grid_triangle(2), source.grid_triangle(2)); });
  EXPECT_GT(touching, 6000);
  EXPECT_LT(touching, 24000);
}

TEST(RationalClipping, AgreesWithTheLinearProgramNearFeatures) {
  TriangleSource source(62);
  const int touching = compare(10000, [&] {
    const TrianglePoints t = source.triangle(Vec3(3, -2, 1), 1.0);
    return std::pair(t, source.near_degenerate_partner(t, 1.0));
  });
  EXPECT_GT(touching, 2000);
  EXPECT_LT(touching, 9000);
}

TEST(RationalClipping, AgreesWithTheLinearProgramAtTheEndsOfTheRange) {
  for (const RangeEnd end : {RangeEnd::kLargest, RangeEnd::kDenormal, RangeEnd::kBoth}) {
    RangeEndSource source(63, end);
    compare(300, [&] { return source.flat_pair(); });
    compare(300, [&] { return source.lattice_pair(); });
    compare(300, [&] { return source.sharing_pair(); });
  }
}

}  // namespace
}  // namespace contactcheck::test
