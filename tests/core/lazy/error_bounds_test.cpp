// How much of their error bounds the filter on lanes and the tests of bounds that are moved between
// two frames take up, in a search for large errors by exact arithmetic. On the instruction set that
// needs no choice: the operations of lanes are the same on all, and what others fuse rounds less.

#include "core/types/vector_targets.h"
// clang-format off: before any header of Highway
#include "core/lazy/meeting-inl.h"
#include "core/lazy/triangles-inl.h"
// clang-format on
#include "tests/core/lazy/translation_errors.h"
#include "tests/support/observed_error.h"
#include "tests/support/random_triangles.h"
#include "tests/support/wide.h"

namespace contactcheck {
namespace {

namespace lanes = HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;
using test::kSixteenth;
using test::magnitude;
using test::TriangleSource;
using test::Wide;

template <typename Real>
using FourPoints = std::array<std::array<Real, 3>, 4>;

// Of the determinant of the points, where they are all that two triangles have.
template <typename Real>
double lane_error_over_bound(const FourPoints<Real>& p) {
  const lanes::PairLanes<Real> d;
  lanes::PointOf<Real> lane[4] = {};
  for (std::size_t i = 0; i < 4; ++i)
    lane[i] = {hn::Set(d, p[i][0]), hn::Set(d, p[i][1]), hn::Set(d, p[i][2])};
  const Real computed = hn::GetLane(lanes::determinant<Real>(lane[0], lane[1], lane[2], lane[3]));
  const lanes::PointOf<Real> first[3] = {lane[0], lane[1], lane[2]};
  const lanes::PointOf<Real> second[3] = {lane[3], lane[3], lane[3]};
  const Real bound = hn::GetLane(lanes::error_bound<Real>(first, second));
  Wide u[4][3];
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) u[i][k] = Wide(p[i][k]) - Wide(p[0][k]);
  Wide exact = 0;
  for (int k = 0; k < 3; ++k) {
    const int s = (k + 1) % 3, t = (k + 2) % 3;
    exact += (u[1][s] * u[2][t] - u[1][t] * u[2][s]) * u[3][k];
  }
  return static_cast<double>(magnitude(computed - exact) / bound);
}

// From corners of a cube on, one of which is the first point.
template <typename Real>
double largest_lane_error(std::uint64_t seed) {
  TriangleSource random(seed);
  const auto make = [&] {
    FourPoints<Real> p;
    for (std::size_t i = 0; i < 4; ++i)
      for (Real& x : p[i])
        x = static_cast<Real>((i == 0 ? 0 : random.below(2)) +
                              std::ldexp(random.unit(), -2 - random.below(38)));
    return p;
  };
  const auto change = [&](FourPoints<Real>& p) {
    Real& x =
        p[static_cast<std::size_t>(random.below(4))][static_cast<std::size_t>(random.below(3))];
    x = static_cast<Real>(
        x + std::ldexp(random.unit(), -random.below(std::numeric_limits<Real>::digits)));
  };
  return test::climb(15, 5000, make, change, lane_error_over_bound<Real>);
}

TEST(ErrorBounds, OfTheFilterOnLanesAreReachedByMoreThanASixteenth) {
  test::report_observed_error("lane filter", largest_lane_error<double>(551), kSixteenth);
  test::report_observed_error("lane filter, floats", largest_lane_error<float>(552), kSixteenth);
}

// A slab of the smaller has a slack of its own that is far below what a test with the larger
// rounds.
TEST(ErrorBounds, OfConcentricBodiesOfTwoSizesAreThoseOfTwoFrames) {
  LazyState small, large;
  small.reach = 0x1p-20, large.reach = 1.0;
  EXPECT_FALSE(lanes::translation_between(small, large).none);
  EXPECT_GT(lanes::translation_between(small, large).slab_slack, 256 * 0x1p-24f);
  EXPECT_TRUE(lanes::translation_between(large, large).none);
}

// No error of its own: the offset is rounded outward. A nearest float would fall short of it.
TEST(ErrorBounds, TranslationsHoldTheOffsetsOfTwoFrames) {
  const double shortfall = test::largest_shortfall_of_translations();
  EXPECT_LE(shortfall, 0.0);
  EXPECT_GT(shortfall, -0x1p-30);
}

// Loose by proof: it adds up the worst of every step, and a search does not see so much together.
TEST(ErrorBounds, OfTestsOfSlabsHold) {
  using test::Along;
  using test::FramePair;
  for (const auto& [frames, name] : {std::pair{FramePair::kOne, "test of slabs in one frame"},
                                     {FramePair::kTwo, "slack of slabs between frames"},
                                     {FramePair::kMoving, "slack of slabs over a step"}})
    for (const Along along : {Along::kMoved, Along::kLane})
      test::report_observed_error(
          std::string(name) + (along == Along::kMoved ? "" : ", along the other's normal"),
          test::largest_error_of_slab_tests(frames, along), 0.002);
}

}  // namespace
}  // namespace contactcheck
