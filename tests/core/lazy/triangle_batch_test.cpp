// The filtered test of eight pairs at a time against triangles_intersect(): it may be unsure, never
// wrong.

#include "core/lazy/triangle_batch.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "core/lazy/kernels.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using test::TriangleSource;
using Pair = std::pair<TrianglePoints, TrianglePoints>;
using MakePair = std::function<Pair(TriangleSource&)>;

void set_lane(TriangleBatch& batch, std::size_t lane, const Pair& pair) {
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) {
      batch.corner[0][c][k][lane] = pair.first[c][k];
      batch.corner[1][c][k][lane] = pair.second[c][k];
    }
}

struct Tally {
  int pairs = 0, met = 0, unknown = 0;
};

// What a verdict says about `pairs`, against the truth; "" or what is wrong.
std::string wrong(const BatchVerdict& verdict, const std::vector<Pair>& pairs, Tally& tally) {
  if ((verdict.meet | verdict.unknown) >> pairs.size() != 0) return "lanes beyond the last";
  if ((verdict.meet & verdict.unknown) != 0) return "certain and unknown at once";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool truth = triangles_intersect(pairs[i].first, pairs[i].second);
    const bool meet = verdict.meet >> i & 1, unknown = verdict.unknown >> i & 1;
    ++tally.pairs, tally.met += truth, tally.unknown += unknown;
    if (!unknown && meet != truth) return truth ? "a contact denied" : "a contact invented";
  }
  return "";
}

// `rounds` batches of 1 to 8 random pairs, on every instruction set, which must agree bit for bit.
// Lanes beyond the last hold what earlier batches left there, or no numbers at all.
Tally judge(std::uint64_t seed, int rounds, const MakePair& make) {
  TriangleSource random(seed);
  Tally tally;
  TriangleBatch batch{};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t lane = 0; lane < kBatchWidth; ++lane)
    set_lane(batch, lane, {{Vec3::Constant(nan), Vec3::Zero(), Vec3::Ones()}, {}});
  for (int round = 0; round < rounds; ++round) {
    std::vector<Pair> pairs(static_cast<std::size_t>(1 + round % 8));
    for (std::size_t i = 0; i < pairs.size(); ++i) set_lane(batch, i, pairs[i] = make(random));
    batch.count = pairs.size();
    const BatchVerdict first = lazy_kernels().test_batch(batch);
    const std::string text = wrong(first, pairs, tally);
    EXPECT_EQ(text, "") << "seed " << seed << " round " << round;
    for (const std::string& isa : lazy_isas()) {
      const BatchVerdict verdict = lazy_kernels(isa).test_batch(batch);
      EXPECT_EQ(verdict.meet, first.meet) << isa << " seed " << seed << " round " << round;
      EXPECT_EQ(verdict.unknown, first.unknown) << isa << " seed " << seed << " round " << round;
    }
  }
  return tally;
}

Pair moved(Pair pair, double scale, const Vec3& offset) {
  for (TrianglePoints* t : {&pair.first, &pair.second})
    for (Vec3& p : *t) p = scale * p + offset;
  return pair;
}

Pair generic_pair(TriangleSource& random) {
  return {random.triangle(Vec3::Zero(), 1.0), random.triangle(Vec3::Zero(), 1.0)};
}

TEST(TriangleBatch, DecidesGenericPairs) {
  const Tally tally = judge(601, 1500, generic_pair);
  EXPECT_LT(100 * tally.unknown, tally.pairs);
  EXPECT_GT(5 * tally.met, tally.pairs / 2);
  EXPECT_LT(5 * tally.met, 4 * tally.pairs);
}

TEST(TriangleBatch, DecidesGenericPairsOfEveryScaleWithinTheFilter) {
  for (double scale : {1e-60, 1e-30, 1e-9, 1e9, 1e80}) {
    const Tally tally = judge(602, 150, [&](TriangleSource& random) {
      return moved(generic_pair(random), scale, scale * random.point(Vec3::Zero(), 1e3));
    });
    EXPECT_LT(100 * tally.unknown, tally.pairs) << scale;
    EXPECT_GT(tally.met, 50) << scale;
  }
}

TEST(TriangleBatch, IsNeverWrongAtAnyScaleAndOffset) {
  for (double scale : {0x1p-1074, 1e-310, 1e-300, 1e-160, 1e-9, 1.0, 1e100, 1e160, 1e300})
    for (double offset : {0.0, 1.0, -1e6, 1e12}) {
      const Vec3 at(offset, -offset, 0.25 * offset);
      judge(603, 24,
            [&](TriangleSource& random) { return moved(generic_pair(random), scale, at); });
      judge(604, 24, [&](TriangleSource& random) {
        return moved({random.grid_triangle(3), random.grid_triangle(3)}, scale, at);
      });
    }
}

TEST(TriangleBatch, IsNeverWrongWhereCornersAreSingleUlpsFromFeatures) {
  const Tally tally = judge(605, 600, [](TriangleSource& random) -> Pair {
    const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
    return {t, random.near_degenerate_partner(t, 1.0)};
  });
  EXPECT_GT(10 * tally.unknown, tally.pairs);
  judge(606, 300, [](TriangleSource& random) -> Pair {  // little of a double left of the offset
    const TrianglePoints t = random.triangle(Vec3::Constant(1e6), 1e-6);
    return {t, random.near_degenerate_partner(t, 1e-6)};
  });
}

TEST(TriangleBatch, IsNeverWrongOnGridsOfTouchingAndDegenerateTriangles) {
  for (int limit : {1, 2, 4}) {
    const Tally tally = judge(607, 500, [&](TriangleSource& random) -> Pair {
      return {random.grid_triangle(limit), random.grid_triangle(limit)};
    });
    EXPECT_GT(20 * tally.unknown, tally.pairs) << limit;
  }
}

TEST(TriangleBatch, IsNeverWrongOnTrianglesThatAreNearlyParallel) {
  for (double gap : {0.0, 1e-17, 1e-16, 1e-15, 1e-12, 1e-6})
    judge(608, 96, [&](TriangleSource& random) -> Pair {
      const TrianglePoints t = random.triangle(Vec3::Ones(), 1.0);
      const Vec3 way = gap * (t[1] - t[0]).cross(t[2] - t[0]);
      const auto near = [&] {
        return Vec3(t[0] + random.unit() * (t[1] - t[0]) + random.unit() * (t[2] - t[0]) +
                    random.unit() * way);
      };
      return {t, {near(), near(), near()}};
    });
}

TEST(TriangleBatch, IsNeverWrongOnNeedlesAndOnVeryDifferentSizes) {
  for (double size : {1e-12, 1e-6, 1e6, 1e150})
    judge(609, 96, [&](TriangleSource& random) -> Pair {
      const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
      return {t, random.triangle(t[0], size)};
    });
  for (double width : {0x1p-1074, 1e-200, 1e-17, 1e-12})
    judge(610, 96, [&](TriangleSource& random) -> Pair {
      const auto needle = [&] {
        const Vec3 a = random.point(Vec3::Zero(), 1.0), b = random.point(Vec3::Zero(), 1.0);
        return TrianglePoints{a, b, a + random.point(Vec3::Zero(), width)};
      };
      return {needle(), needle()};
    });
}

Pair stretched(Pair pair, const Vec3& by) {
  for (TrianglePoints* t : {&pair.first, &pair.second})
    for (Vec3& p : *t) p = p.cwiseProduct(by);
  return pair;
}

Pair near_degenerate_pair(TriangleSource& random) {
  const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
  return {t, random.near_degenerate_partner(t, 1.0)};
}

// Determinants become denormal numbers of few bits while all coordinates are ordinary.
TEST(TriangleBatch, IsNeverWrongWhereDeterminantsUnderflow) {
  for (int exponent = -360; exponent <= -330; exponent += 3)
    judge(612, 200, [&](TriangleSource& random) {
      return moved(near_degenerate_pair(random), std::ldexp(1.0, exponent), Vec3::Zero());
    });
}

// A minor overflows where the determinant does not: times a tiny difference, it is no infinity.
TEST(TriangleBatch, IsNeverWrongWhereAxesHaveVeryDifferentScales) {
  for (int axis = 0; axis < 3; ++axis)
    for (int tiny : {-900, -600, -300})
      for (int huge : {520, 600, 700}) {
        Vec3 by = Vec3::Constant(std::ldexp(1.0, huge));
        by[axis] = std::ldexp(1.0, tiny);
        judge(613, 48, [&](TriangleSource& random) { return stretched(generic_pair(random), by); });
      }
}

const TrianglePoints kFlat = {Vec3(0, 0, 0), Vec3(8, 0, 1), Vec3(0, 8, 2)};

// Pairs that have a corner in common.
std::vector<Pair> pairs_with_a_common_corner() {
  const Vec3 inside(2, 2, 0.75);
  return {
      {kFlat, kFlat},
      {kFlat, {kFlat[1], kFlat[0], Vec3(3, -5, 7)}},          // an edge
      {kFlat, {kFlat[0], Vec3(-3, -4, 7), Vec3(-5, -1, 6)}},  // a corner
      {kFlat, {Vec3(-3, -4, 7), Vec3(-5, -1, 6), kFlat[2]}},  // another
      {kFlat, {0.5 * kFlat[1], 0.5 * kFlat[2], kFlat[0]}},    // coplanar
      {kFlat, {kFlat[2], kFlat[2], kFlat[2]}},                // a point
      {{inside, inside, inside}, {inside, inside, inside}},
  };
}

// Pairs that meet, but in their boundaries, in one plane, or as less than triangles. Of short
// binary fractions, so that they do so exactly.
std::vector<Pair> touching_pairs() {
  const TrianglePoints flat = kFlat;
  const Vec3 inside(2, 2, 0.75);
  return {
      {flat, {inside, Vec3(1, 1, 9), Vec3(4, 1, 8)}},                  // a corner in the interior
      {flat, {Vec3(4, 0, 0.5), Vec3(4, -2, 8), Vec3(5, -2, 8)}},       // a corner on an edge
      {flat, {Vec3(4, -1, -0.5), Vec3(4, 1, 1.5), Vec3(4, -9, 1)}},    // edge against edge
      {flat, {inside, inside, inside}},                                // a point
      {flat, {inside - Vec3::Ones(), inside, inside + Vec3::Ones()}},  // a segment
      {flat, {0.5 * flat[1], 0.5 * flat[2], Vec3(1, 1, 0.375)}},       // coplanar
  };
}

TEST(TriangleBatch, SeesCommonCornersAtEveryScale) {
  for (const std::string& isa : lazy_isas())
    for (double scale : {0x1p-1070, 0x1p-332, 0x1p-100, 1.0, 0x1p300, 0x1p1000})
      for (std::size_t lane = 0; lane < kBatchWidth; ++lane)
        for (const Pair& pair : pairs_with_a_common_corner()) {
          TriangleBatch batch{};
          set_lane(batch, lane, moved(pair, scale, Vec3::Zero()));
          batch.count = lane + 1;
          ASSERT_TRUE(triangles_intersect(batch.points(0, lane), batch.points(1, lane)));
          const BatchVerdict verdict = lazy_kernels(isa).test_batch(batch);
          EXPECT_EQ(verdict.meet >> lane, 1u) << isa << " " << lane << " " << scale;
          EXPECT_EQ(verdict.unknown >> lane, 0u);
        }
}

TEST(TriangleBatch, LeavesPairsThatMeetWithoutCrossingToTheExactTest) {
  for (const std::string& isa : lazy_isas())
    for (double scale : {0x1p-332, 0x1p-100, 1.0, 0x1p100, 0x1p300})
      for (std::size_t lane = 0; lane < kBatchWidth; ++lane)
        for (const Pair& pair : touching_pairs()) {
          TriangleBatch batch{};
          set_lane(batch, lane, moved(pair, scale, Vec3::Zero()));
          batch.count = lane + 1;
          ASSERT_TRUE(triangles_intersect(batch.points(0, lane), batch.points(1, lane)));
          const BatchVerdict verdict = lazy_kernels(isa).test_batch(batch);
          EXPECT_EQ(verdict.unknown >> lane, 1u) << isa << " " << lane << " " << scale;
          EXPECT_EQ(verdict.meet >> lane, 0u);
        }
}

TEST(TriangleBatch, DecidesEachLaneForItself) {
  const TrianglePoints flat = kFlat;
  const Pair touching = {flat, {Vec3(2, 2, 0.75), Vec3(1, 1, 9), Vec3(4, 1, 8)}};
  const Pair crossing = {flat, {Vec3(2, 2, -5), Vec3(2, 1, 6), Vec3(3, 2, 6)}};
  const Pair apart = {flat, {Vec3(2, 2, 5), Vec3(2, 1, 6), Vec3(3, 2, 6)}};
  for (const std::string& isa : lazy_isas())
    for (std::uint32_t pattern = 0; pattern < 6561; pattern += 23) {  // 3^8
      TriangleBatch batch{};
      BatchVerdict expected;
      batch.count = kBatchWidth;
      for (std::uint32_t lane = 0, rest = pattern; lane < kBatchWidth; ++lane, rest /= 3) {
        set_lane(batch, lane, rest % 3 == 0 ? apart : rest % 3 == 1 ? crossing : touching);
        (rest % 3 == 1 ? expected.meet : expected.unknown) |= std::uint32_t{rest % 3 != 0} << lane;
      }
      const BatchVerdict verdict = lazy_kernels(isa).test_batch(batch);
      EXPECT_EQ(verdict.meet, expected.meet) << isa << " " << pattern;
      EXPECT_EQ(verdict.unknown, expected.unknown) << isa << " " << pattern;
    }
}

TEST(TriangleBatch, IsTheSameInEveryOrderOfTheCornersAndTriangles) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  TriangleSource random(611);
  for (int round = 0; round < 120; ++round) {
    const auto [p, q] = generic_pair(random);
    const bool truth = triangles_intersect(p, q);
    for (int swap = 0; swap < 2; ++swap)
      for (const auto& first : kOrders) {
        TriangleBatch batch{};
        batch.count = 6;
        for (std::size_t lane = 0; lane < 6; ++lane) {
          const TrianglePoints a = {p[first[0]], p[first[1]], p[first[2]]};
          const auto& second = kOrders[lane];
          const TrianglePoints b = {q[second[0]], q[second[1]], q[second[2]]};
          set_lane(batch, lane, swap ? Pair{b, a} : Pair{a, b});
        }
        const BatchVerdict verdict = lazy_kernels().test_batch(batch);
        EXPECT_EQ(verdict.meet | verdict.unknown, truth ? 0x3fu : verdict.unknown);
        EXPECT_LE(std::popcount(verdict.unknown), 1) << round;
      }
  }
}

}  // namespace
}  // namespace contactcheck
