// The filtered test of eight pairs at a time, of doubles and of floats, against the exact test of
// the same numbers: it may be unsure, never wrong, and on every instruction set the same.

#include <bit>
#include <cmath>
#include <vector>

#include "tests/core/lazy/triangle_batches.h"

namespace contactcheck {
namespace {

using test::DoublePair;
using test::moved;
using test::Tally;
using test::TriangleSource;

template <typename Real>
using TriangleBatches = test::TriangleBatches<Real>;
using Precisions = ::testing::Types<double, float>;
TYPED_TEST_SUITE(TriangleBatches, Precisions);

DoublePair generic_pair(TriangleSource& random) {
  const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
  return {t, random.triangle(Vec3::Zero(), 1.0)};
}

DoublePair near_degenerate_pair(TriangleSource& random) {
  const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
  return {t, random.near_degenerate_partner(t, 1.0)};
}

TYPED_TEST(TriangleBatches, DecideGenericPairsOfEveryScaleWithinTheFilter) {
  for (double scale : this->ranges.decided) {
    const Tally tally = this->judge(641, 1200, [&](TriangleSource& random) {
      return moved(generic_pair(random), scale, Vec3::Zero());
    });
    EXPECT_LT(1000 * tally.unknown, tally.pairs) << scale;
    EXPECT_GT(5 * tally.met, tally.pairs / 2) << scale;
    EXPECT_LT(5 * tally.met, 4 * tally.pairs) << scale;
  }
}

TYPED_TEST(TriangleBatches, DecideGenericPairsAThousandTimesTheirSizeAway) {
  for (double scale : this->ranges.decided) {
    const Tally tally = this->judge(602, 150, [&](TriangleSource& random) {
      return moved(generic_pair(random), scale, scale * random.point(Vec3::Zero(), 1e3));
    });
    EXPECT_LT(100 * tally.unknown, tally.pairs) << scale;
    EXPECT_GT(tally.met, 50) << scale;
  }
}

TYPED_TEST(TriangleBatches, AreNeverWrongAtAnyScaleAndOffset) {
  for (double scale : this->ranges.scales)
    for (double offset : this->ranges.offsets) {
      const Vec3 at(offset, -offset, 0.25 * offset);
      this->judge(603, 24,
                  [&](TriangleSource& random) { return moved(generic_pair(random), scale, at); });
      this->judge(604, 24, [&](TriangleSource& random) {
        return moved({random.grid_triangle(3), random.grid_triangle(3)}, scale, at);
      });
    }
}

// Many corners coincide, and many determinants are 0.
TYPED_TEST(TriangleBatches, AreNeverWrongWhereFewDigitsAreLeft) {
  for (double offset : this->ranges.few_digits) {
    const Tally tally = this->judge(642, 600, [&](TriangleSource& random) {
      return moved(generic_pair(random), 1.0, Vec3(offset, -offset, 0.3 * offset));
    });
    EXPECT_GT(tally.met, 100) << offset;
  }
}

TYPED_TEST(TriangleBatches, AreNeverWrongWhereCornersAreSingleUlpsFromFeatures) {
  const Tally tally = this->judge(605, 1200, near_degenerate_pair);
  EXPECT_GT(20 * tally.unknown, tally.pairs);
  this->judge(606, 300, [](TriangleSource& random) -> DoublePair {  // few digits of the offset left
    const TrianglePoints t = random.triangle(Vec3::Constant(1e6), 1e-6);
    return {t, random.near_degenerate_partner(t, 1e-6)};
  });
}

TYPED_TEST(TriangleBatches, AreNeverWrongOnGridsOfTouchingAndDegenerateTriangles) {
  for (int limit : {1, 2, 4})
    for (double scale : this->ranges.grids) {
      const Tally tally = this->judge(607, 300, [&](TriangleSource& random) {
        return moved({random.grid_triangle(limit), random.grid_triangle(limit)}, scale,
                     Vec3::Zero());
      });
      EXPECT_GT(20 * tally.unknown, tally.pairs) << limit << " " << scale;
    }
}

// Two triangles nearly in one plane, the second `apart` beside the first.
DoublePair pair_in_a_plane(TriangleSource& random, double apart) {
  const Vec3 u = random.point(Vec3::Zero(), 1.0), v = random.point(Vec3::Zero(), 1.0);
  const auto in_plane = [&](double from) -> TrianglePoints {
    const auto corner = [&] {
      const Vec3 at = random.point(Vec3(from, 0, 0), 0.5);
      return Vec3(at.x() * u + at.y() * v);
    };
    return {corner(), corner(), corner()};
  };
  return {in_plane(0.0), in_plane(apart)};
}

// A sign is noise, and is not believed. Those that are apart in a view along an axis are told.
TYPED_TEST(TriangleBatches, BelieveNoSignInOneTiltedPlane) {
  const Tally tally =
      this->judge(647, 600, [](TriangleSource& random) { return pair_in_a_plane(random, 0.6); });
  EXPECT_GT(10 * tally.unknown, tally.pairs) << "there is noise";
  EXPECT_LT(2 * tally.met, tally.pairs);
  const Tally apart =
      this->judge(648, 600, [](TriangleSource& random) { return pair_in_a_plane(random, 1.5); });
  EXPECT_LT(100 * apart.unknown, apart.pairs);
}

// As on a flat part of a surface: across an edge, and across a corner of a grid, where no edge of
// either parts the two.
TYPED_TEST(TriangleBatches, DecideNeighboursInOnePlane) {
  const auto in_plane = [](TriangleSource& random) { return pair_in_a_plane(random, 0.0).first; };
  const auto across_edge = [&](TriangleSource& random) -> DoublePair {
    const TrianglePoints t = in_plane(random);
    return {t, {t[0], t[1], Vec3(t[0] + t[1] - t[2])}};
  };
  const auto across_corner = [&](TriangleSource& random) -> DoublePair {
    const TrianglePoints t = in_plane(random);
    return {t, {t[0], Vec3(2 * t[0] - t[1]), Vec3(2 * t[0] - t[2])}};
  };
  for (const Tally& tally :
       {this->judge(649, 600, across_edge, 2), this->judge(650, 600, across_corner, 1)}) {
    EXPECT_EQ(tally.met, 0);
    EXPECT_LT(100 * tally.unknown, tally.pairs);
  }
  const Tally over = this->judge(
      656, 600, [](TriangleSource& random) { return pair_in_a_plane(random, 0.0); }, 2);
  EXPECT_GT(4 * over.unknown, over.pairs) << "on one side of the edge";
}

TYPED_TEST(TriangleBatches, AreNeverWrongOnNeighbours) {
  for (const std::uint32_t shared : {1u, 2u}) {
    const Tally tally = this->judge(651, 1200, generic_pair, shared);
    EXPECT_LT(1000 * tally.unknown, tally.pairs);
    EXPECT_GT(this->judge(652, 1200, near_degenerate_pair, shared).unknown, 0);
    for (int limit : {1, 2, 4})
      for (double scale : this->ranges.grids)
        this->judge(
            653, 300,
            [&](TriangleSource& random) {
              return moved({random.grid_triangle(limit), random.grid_triangle(limit)}, scale,
                           Vec3::Zero());
            },
            shared);
    for (double scale : this->ranges.scales)
      for (double offset : this->ranges.offsets)
        this->judge(
            654, 24,
            [&](TriangleSource& random) {
              return moved(pair_in_a_plane(random, 0.3), scale, Vec3(offset, -offset, 0.0));
            },
            shared);
    for (int exponent : this->ranges.underflow)
      this->judge(
          655, 300,
          [&](TriangleSource& random) {
            return moved(pair_in_a_plane(random, 0.3), std::ldexp(1.0, exponent), Vec3::Zero());
          },
          shared);
  }
}

TYPED_TEST(TriangleBatches, AreNeverWrongOnTrianglesThatAreNearlyParallel) {
  for (double gap : this->ranges.gaps)
    this->judge(608, 96, [&](TriangleSource& random) -> DoublePair {
      const TrianglePoints t = random.triangle(Vec3::Ones(), 1.0);
      const Vec3 offset = gap * (t[1] - t[0]).cross(t[2] - t[0]);
      const auto near = [&] {
        return Vec3(t[0] + random.unit() * (t[1] - t[0]) + random.unit() * (t[2] - t[0]) +
                    random.unit() * offset);
      };
      return {t, {near(), near(), near()}};
    });
}

TYPED_TEST(TriangleBatches, AreNeverWrongOnNeedlesAndOnVeryDifferentSizes) {
  for (double size : this->ranges.sizes)
    this->judge(609, 96, [&](TriangleSource& random) -> DoublePair {
      const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
      return {t, random.triangle(t[0], size)};
    });
  for (double width : this->ranges.widths)
    this->judge(610, 200, [&](TriangleSource& random) -> DoublePair {
      const auto needle = [&] {
        const Vec3 a = random.point(Vec3::Zero(), 1.0), b = random.point(Vec3::Zero(), 1.0);
        return TrianglePoints{a, b, a + random.point(Vec3::Zero(), width)};
      };
      return {needle(), needle()};
    });
}

// Determinants become denormal numbers of few bits while all coordinates are ordinary.
TYPED_TEST(TriangleBatches, AreNeverWrongWhereDeterminantsUnderflow) {
  for (int exponent : this->ranges.underflow)
    this->judge(612, 300, [&](TriangleSource& random) {
      return moved(near_degenerate_pair(random), std::ldexp(1.0, exponent), Vec3::Zero());
    });
}

// Of doubles a minor overflows where the determinant does not: times a tiny difference, it is no
// infinity.
TYPED_TEST(TriangleBatches, AreNeverWrongWhereAxesHaveVeryDifferentScales) {
  for (int axis = 0; axis < 3; ++axis)
    for (int tiny : this->ranges.tiny)
      for (int huge : this->ranges.huge) {
        Vec3 by = Vec3::Constant(std::ldexp(1.0, huge));
        by[axis] = std::ldexp(1.0, tiny);
        this->judge(613, 48, [&](TriangleSource& random) {
          DoublePair pair = generic_pair(random);
          for (TrianglePoints* t : {&pair.first, &pair.second})
            for (Vec3& p : *t) p = p.cwiseProduct(by);
          return pair;
        });
      }
}

const TrianglePoints kFlat = {Vec3(0, 0, 0), Vec3(8, 0, 1), Vec3(0, 8, 2)};

// Pairs that have a corner in common.
std::vector<DoublePair> pairs_with_a_common_corner() {
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
std::vector<DoublePair> touching_pairs() {
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

TYPED_TEST(TriangleBatches, SeeCommonCornersAtEveryScale) {
  const auto certain = [](const BatchVerdict& verdict, std::size_t lane) {
    EXPECT_EQ(verdict.meet >> lane, 1u);
    EXPECT_EQ(verdict.unknown >> lane, 0u);
  };
  this->in_every_lane(this->ranges.powers, pairs_with_a_common_corner(), certain);
  this->in_every_lane({this->ranges.farthest}, pairs_with_a_common_corner(), certain);
}

TYPED_TEST(TriangleBatches, LeavePairsThatMeetWithoutCrossingToTheExactTest) {
  this->in_every_lane(this->ranges.powers, touching_pairs(),
                      [](const BatchVerdict& verdict, std::size_t lane) {
                        EXPECT_EQ(verdict.unknown >> lane, 1u);
                        EXPECT_EQ(verdict.meet >> lane, 0u);
                      });
}

TYPED_TEST(TriangleBatches, DecideEachLaneForItself) {
  const DoublePair touching = {kFlat, {Vec3(2, 2, 0.75), Vec3(1, 1, 9), Vec3(4, 1, 8)}};
  const DoublePair crossing = {kFlat, {Vec3(2, 2, -5), Vec3(2, 1, 6), Vec3(3, 2, 6)}};
  const DoublePair apart = {kFlat, {Vec3(2, 2, 5), Vec3(2, 1, 6), Vec3(3, 2, 6)}};
  for (const std::string& isa : lazy_isas())
    for (std::uint32_t pattern = 0; pattern < 6561; pattern += 23) {  // 3^8
      TriangleBatchOf<TypeParam> batch{};
      BatchVerdict expected;
      batch.count = kBatchWidth;
      for (std::uint32_t lane = 0, rest = pattern; lane < kBatchWidth; ++lane, rest /= 3) {
        const DoublePair& pair = rest % 3 == 0 ? apart : rest % 3 == 1 ? crossing : touching;
        this->set_lane(batch, lane, this->rounded(pair));
        (rest % 3 == 1 ? expected.meet : expected.unknown) |= std::uint32_t{rest % 3 != 0} << lane;
      }
      const BatchVerdict verdict = this->tested(lazy_kernels(isa), batch);
      EXPECT_EQ(verdict.meet, expected.meet) << isa << " " << pattern;
      EXPECT_EQ(verdict.unknown, expected.unknown) << isa << " " << pattern;
    }
}

TYPED_TEST(TriangleBatches, AreTheSameInEveryOrderOfTheCornersAndTriangles) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  TriangleSource random(611);
  for (int round = 0; round < 120; ++round) {
    const auto [p, q] = this->rounded(generic_pair(random));
    const bool truth = triangles_intersect(p, q);
    for (int swap = 0; swap < 2; ++swap)
      for (const auto& first : kOrders) {
        TriangleBatchOf<TypeParam> batch{};
        batch.count = 6;
        for (std::size_t lane = 0; lane < 6; ++lane) {
          const TrianglePointsOf<TypeParam> a = {p[first[0]], p[first[1]], p[first[2]]};
          const auto& second = kOrders[lane];
          const TrianglePointsOf<TypeParam> b = {q[second[0]], q[second[1]], q[second[2]]};
          if (swap) {
            this->set_lane(batch, lane, {b, a});
          } else {
            this->set_lane(batch, lane, {a, b});
          }
        }
        const BatchVerdict verdict = this->tested(lazy_kernels(), batch);
        EXPECT_EQ(verdict.meet | verdict.unknown, truth ? 0x3fu : verdict.unknown);
        EXPECT_LE(std::popcount(verdict.unknown), 1) << round;
      }
  }
}

}  // namespace
}  // namespace contactcheck
