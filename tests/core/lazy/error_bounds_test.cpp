// How much of their error bounds the filter on lanes and the translation between two frames take
// up, in a search for large errors by exact arithmetic. On the instruction set that needs no
// choice: the operations of lanes are the same on all, and what others fuse rounds less.

#include "core/types/vector_targets.h"
// clang-format off: before any header of Highway
#include "core/lazy/meeting-inl.h"
#include "core/lazy/triangles-inl.h"
// clang-format on
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

// Two frames, a slab of the first and a lane of the second.
struct Frames {
  Vec3 from, to;        // origins
  double middle = 0.0;  // of the slab that is moved, along `axis`
  int axis = 0;
  std::array<float, 3> normal{}, lo{}, hi{};  // of the lane in the other frame
  float lane_middle = 0.0f, lane_half = 0.0f;
};

// The sum of both reaches is no more than the offset between the frames asks for.
void set_states(const Frames& f, LazyState& from, LazyState& to) {
  from.origin = f.from, to.origin = f.to;
  from.reach = to.reach = 0.5 * (f.from - f.to).cwiseAbs().maxCoeff();
}

Frames random_frames(TriangleSource& random) {
  Frames out;
  out.from = random.point(Vec3::Zero(), 1.0), out.to = random.point(Vec3::Zero(), 1.0);
  out.axis = random.below(3);
  out.middle = random.unit();
  const Vec3 normal = random.point(Vec3::Zero(), 1.0).normalized();
  for (std::size_t k = 0; k < 3; ++k) {
    out.normal[k] = static_cast<float>(normal[static_cast<int>(k)]);
    const double a = random.unit(), b = random.unit();
    out.lo[k] = static_cast<float>(std::min(a, b)), out.hi[k] = static_cast<float>(std::max(a, b));
  }
  out.lane_middle = static_cast<float>(random.unit());
  out.lane_half = static_cast<float>(std::abs(random.unit()));
  return out;
}

void change_frames(TriangleSource& random, Frames& f) {
  const auto little = [&] { return std::ldexp(random.unit(), -random.below(26)); };
  f.from[random.below(3)] += little();
  f.to[random.below(3)] += little();
  f.middle += little();
  f.lane_middle += static_cast<float>(little());
  const auto k = static_cast<std::size_t>(random.below(3));
  f.hi[k] = std::max(f.lo[k], f.hi[k] + static_cast<float>(little()));
}

// A bound at 0 becomes what the offset and the slack are together: the sum with another bound is
// compared with floats, and its rounding costs nothing.
double moved_box_error(const Frames& f) {
  LazyState from, to;
  set_states(f, from, to);
  const lanes::Translation translation = lanes::translation_between(from, to);
  const LaneBoxes zero{};
  const LaneSlabs none{};
  const lanes::MovedBounds moved{{zero, &none, 0}, translation};
  double largest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Wide exact = Wide(f.from[k]) - f.to[k];
    largest = std::max({largest, static_cast<double>(exact + translation.slack - moved.hi(k)),
                        static_cast<double>(Wide(moved.lo(k)) + translation.slack - exact)});
  }
  return largest / translation.slack;
}

// The test of slabs, along an axis, so that the factor a has no error, which would be none of the
// test. Found by bisection: at which half-width of the slab the test no longer separates. `moved`:
// between two frames; else in one, whose slack LazyState has.
double slab_test_error(const Frames& f, bool moved) {
  LazyState from, to;
  set_states(f, from, to);
  const lanes::Translation translation = lanes::translation_between(from, to);
  LaneBoxes everything{};
  LaneSlabs slab{};
  BlockBounds lane{};
  for (int k = 0; k < 3; ++k) {
    everything.lo[k][0] = -1e20f, everything.hi[k][0] = 1e20f;  // the other half of the test passes
    slab.normal[k][0] = k == f.axis ? 1.0f : 0.0f;
    lane.slab.normal[k][0] = f.normal[static_cast<std::size_t>(k)];
    lane.box.lo[k][0] = f.lo[static_cast<std::size_t>(k)];
    lane.box.hi[k][0] = f.hi[static_cast<std::size_t>(k)];
  }
  lane.slab.middle[0] = f.lane_middle, lane.slab.half[0] = f.lane_half;
  slab.middle[0] = static_cast<float>(f.middle);
  const Wide a = f.normal[static_cast<std::size_t>(f.axis)];
  Wide theirs = a * f.lane_middle;
  Wide their_half = magnitude(a * f.lane_half);
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide rest = (static_cast<int>(k) == f.axis) - a * f.normal[k];
    theirs += rest * (Wide(f.lo[k]) + f.hi[k]) / 2;
    their_half += magnitude(rest * (Wide(f.hi[k]) - f.lo[k]) / 2);
  }
  Wide middle = slab.middle[0];
  if (moved) middle += Wide(f.from[f.axis]) - f.to[f.axis];
  const auto wanted = static_cast<double>(magnitude(middle - theirs) - their_half);
  const lanes::ChildBounds child{everything, &slab, 0};
  double low = wanted - 1e-3, high = wanted + 1e-3;
  while (high - low > 1e-9) {
    const double half = 0.5 * (low + high);
    slab.half[0] = static_cast<float>(half);
    const std::uint32_t meets =
        moved ? lanes::not_separated(lanes::MovedBounds{child, translation}, lane)
              : lanes::not_separated(child, lane);
    (meets & 1 ? high : low) = half;
  }
  const double slack = moved ? static_cast<double>(translation.slab_slack)
                             : 384 * 0x1p-24 * std::max(1.0, from.reach);
  return (high - wanted + (moved ? slack : 0.0)) / slack;
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

TEST(ErrorBounds, OfBoxesBetweenFramesAreReachedByMoreThanASixteenth) {
  TriangleSource random(553);
  const auto make = [&] { return random_frames(random); };
  const auto change = [&](Frames& f) { change_frames(random, f); };
  test::report_observed_error("slack of boxes between frames",
                              test::climb(10, 2000, make, change, moved_box_error), kSixteenth);
}

// Loose by proof: it adds up the worst of every step, and a search does not see so much together.
TEST(ErrorBounds, OfTestsOfSlabsHold) {
  for (bool moved : {false, true}) {
    TriangleSource random(554);
    const auto make = [&] { return random_frames(random); };
    const auto change = [&](Frames& f) { change_frames(random, f); };
    test::report_observed_error(
        moved ? "slack of slabs between frames" : "test of slabs in one frame",
        test::climb(4, 1000, make, change,
                    [&](const Frames& f) { return slab_test_error(f, moved); }),
        0.002);
  }
}

}  // namespace
}  // namespace contactcheck
