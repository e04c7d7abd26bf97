// What libccd says about two pieces, and that every call ends. What it gets wrong is expected as
// such: a test that fails here may mean that libccd was mended.
#include "reference/adapters/libccd_call.h"

#include <gmock/gmock.h>

#include "core/deform/lattice.h"
#include "core/narrow/triangle_triangle.h"
#include "reference/oracle/convex_penetration.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Lt;

constexpr adapters::CcdAlgorithm kBoth[] = {adapters::CcdAlgorithm::kGjk,
                                            adapters::CcdAlgorithm::kMpr};

adapters::CcdSettings settings(adapters::CcdAlgorithm algorithm, std::uint32_t iterations = 100,
                               double scale = 1.0) {
  adapters::CcdSettings out;
  out.algorithm = algorithm;
  out.iterations = iterations;
  out.scale = scale;
  return out;
}

Corners cuboid(const Vec3& lo, const Vec3& sides) {
  Corners out;
  for (int c = 0; c < 8; ++c)
    out[c] = lo + Vec3(c & 1 ? sides.x() : 0, c & 2 ? sides.y() : 0, c & 4 ? sides.z() : 0);
  return out;
}
/// Of a box whose corners are numbered as cuboid()'s are.
std::vector<oracle::TriangleCorners> surface(const Corners& box) {
  std::vector<oracle::TriangleCorners> out;
  for (const auto& [a, b, c, d] : {std::array{0, 1, 3, 2},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 3, 7, 6},
                                   {0, 2, 6, 4},
                                   {1, 3, 7, 5}}) {
    out.push_back({box[a], box[b], box[c]});
    out.push_back({box[a], box[c], box[d]});
  }
  return out;
}
Corners cube(const Vec3& lo, double side = 1.0) { return cuboid(lo, Vec3::Constant(side)); }

bool hit(adapters::CcdAlgorithm algorithm, adapters::CcdPiece a, adapters::CcdPiece b) {
  adapters::CcdCaller caller(settings(algorithm));
  return caller.intersect(a, b);
}

TEST(LibccdCall, TellsCubesThatOverlapFromCubesApart) {
  for (const adapters::CcdAlgorithm algorithm : kBoth) {
    EXPECT_TRUE(hit(algorithm, cube(Vec3(0, 0, 0)), cube(Vec3(0.75, 0.5, -0.25))));
    EXPECT_FALSE(hit(algorithm, cube(Vec3(0, 0, 0)), cube(Vec3(1.01, 0.5, -0.25))));
    adapters::CcdCaller caller(settings(algorithm));
    EXPECT_FALSE(caller.penetrate(cube(Vec3(0, 0, 0)), cube(Vec3(1.01, 0, 0))).contact);
  }
}

TEST(LibccdCall, DepthIsHowFarAndTheNormalWhereTheSecondPieceHasToGo) {
  const Corners still = cube(Vec3(0, 0, 0));
  for (const adapters::CcdAlgorithm algorithm : kBoth) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Vec3 lo(0.13, 0.07, 0.11);
        lo[axis] = 0.9 * sign;
        for (const double scale : {1.0, 64.0, 3.0, 0.0}) {
          adapters::CcdCaller caller(settings(algorithm, 100, scale));
          const Vec3 out = sign * Vec3::Unit(axis);
          const adapters::CcdPenetration moved = caller.penetrate(still, cube(lo));
          ASSERT_TRUE(moved.translation) << axis << " " << sign << " " << scale;
          EXPECT_NEAR(moved.translation->depth, 0.1, 1e-9);
          EXPECT_NEAR((moved.translation->normal - out).norm(), 0.0, 1e-9);
          const adapters::CcdPenetration swapped = caller.penetrate(cube(lo), still);
          ASSERT_TRUE(swapped.translation) << axis << " " << sign << " " << scale;
          EXPECT_NEAR(swapped.translation->depth, 0.1, 1e-9);
          EXPECT_NEAR((swapped.translation->normal + out).norm(), 0.0, 1e-9);
        }
      }
    }
  }
}

// The second cube is 1 wide about the middle of one 2 wide: 1.5 along an axis parts them.
TEST(LibccdCall, OfConcentricCubesMprGivesMoreThanTheShortestWay) {
  const Corners big = cube(Vec3(-1, -1, -1), 2), small = cube(Vec3(-0.5, -0.5, -0.5));
  adapters::CcdCaller gjk(settings(adapters::CcdAlgorithm::kGjk)),
      mpr(settings(adapters::CcdAlgorithm::kMpr));
  EXPECT_NEAR(gjk.penetrate(big, small).translation.value().depth, 1.5, 1e-9);
  EXPECT_NEAR(mpr.penetrate(big, small).translation.value().depth, 1.6583, 1e-3);
}

// libccd 2.1, prior work C1: GJK ends on a face of the difference, and EPA takes that for touching.
// It hangs on the last bits: cubes whose corners are short binary fractions get their depth.
TEST(LibccdCall, CubesInLineAreInContactWithoutADirectionForGjk) {
  const Vec3 one = Vec3::Ones();
  const Corners a = cube(-one, 2), b = cube(Vec3(0, 0, 1.9) - one, 2);
  adapters::CcdCaller gjk(settings(adapters::CcdAlgorithm::kGjk)),
      mpr(settings(adapters::CcdAlgorithm::kMpr));
  const adapters::CcdPenetration found = gjk.penetrate(a, b);
  EXPECT_TRUE(found.contact);
  EXPECT_FALSE(found.translation);
  EXPECT_EQ(gjk.without_direction(), 1u);
  EXPECT_THAT(gjk.notes(), ElementsAre(HasSubstr("no finite depth or no direction")));
  EXPECT_NEAR(mpr.penetrate(a, b).translation.value().depth, 0.1, 1e-9);
  EXPECT_THAT(mpr.notes(), IsEmpty());
}

// libccd 2.1, prior work C8 and C7.
TEST(LibccdCall, TouchingCubesAreAHitForGjkAndNoneForMpr) {
  const Corners a = cube(Vec3(0, 0, 0)), face = cube(Vec3(1, 0.25, 0.25), 0.5);
  for (const bool swapped : {false, true}) {
    const adapters::CcdPiece first = swapped ? face : a, second = swapped ? a : face;
    adapters::CcdCaller gjk(settings(adapters::CcdAlgorithm::kGjk)),
        mpr(settings(adapters::CcdAlgorithm::kMpr));
    EXPECT_TRUE(gjk.intersect(first, second));
    const adapters::CcdPenetration found = gjk.penetrate(first, second);
    EXPECT_TRUE(found.contact);
    EXPECT_FALSE(found.translation);
    EXPECT_FALSE(mpr.intersect(first, second));
    EXPECT_FALSE(mpr.penetrate(first, second).contact);
  }
}

// libccd 2.1: whether GJK sees aligned cubes touch depends on which comes first.
TEST(LibccdCall, GjkLosesATouchThatItSeesTheOtherWayRound) {
  const Corners a = cube(Vec3(0, 0, 0)), b = cube(Vec3(1, 0, 0));
  EXPECT_TRUE(hit(adapters::CcdAlgorithm::kGjk, a, b));
  EXPECT_FALSE(hit(adapters::CcdAlgorithm::kGjk, b, a));
}

/// libccd 2.1, prior work C2: a triangle that is a segment and one that shares an end with it.
/// MPR's refinement goes round for ever.
const TrianglePoints kLoopA = {Vec3(0, 1, 0), Vec3(0, 1, 0), Vec3(2, 1, 2)};
const TrianglePoints kLoopB = {Vec3(0, 1, 0), Vec3(2, 0, 3), Vec3(2, 1, 2)};

TEST(LibccdCall, AnEndlessLoopOfMprIsEndedAndCountsAsNoContact) {
  ASSERT_TRUE(triangles_intersect(kLoopA, kLoopB));
  for (const std::uint32_t iterations : {1u, 100u, 100000u}) {
    adapters::CcdCaller caller(settings(adapters::CcdAlgorithm::kMpr, iterations));
    EXPECT_FALSE(caller.intersect(kLoopA, kLoopB));
    EXPECT_EQ(caller.verdict_limits(), 1u);
    // One call more than allowed; a second one may follow where two loops have to be left.
    EXPECT_THAT(caller.support_calls(), AllOf(Gt(iterations), Le(iterations + 5)));
    EXPECT_THAT(caller.notes(), ElementsAre(HasSubstr("count as no contact")));
    EXPECT_FALSE(caller.penetrate(kLoopA, kLoopB).contact);
  }
  EXPECT_TRUE(hit(adapters::CcdAlgorithm::kGjk, kLoopA, kLoopB));
}

TEST(LibccdCall, GjkThatUsesUpItsIterationsCountsAsNoContact) {
  const Corners a = cube(Vec3(0, 0, 0)), b = cube(Vec3(0.75, 0.5, -0.25));
  adapters::CcdCaller one(settings(adapters::CcdAlgorithm::kGjk, 1));
  EXPECT_FALSE(one.intersect(a, b));
  EXPECT_FALSE(one.penetrate(a, b).contact);
  EXPECT_EQ(one.verdict_limits(), 2u);
  EXPECT_EQ(one.support_calls(), 4u);
  EXPECT_THAT(one.notes(), ElementsAre(HasSubstr("count as no contact")));
}

/// Of radius 1.
std::vector<Vec3> ball(TriangleSource& random, const Vec3& center, int points) {
  std::vector<Vec3> out;
  for (int i = 0; i < points; ++i)
    out.push_back(center + random.point(Vec3::Zero(), 1).normalized());
  return out;
}

// libccd 2.1: EPA replaces one face at a time and keeps the others that see the new point, so its
// polytope gets dents, and the nearest dent is taken for the depth. About 1.87 parts these.
TEST(LibccdCall, DepthOfRoundPiecesIsFarTooSmallByEpaAndABitTooLargeByMpr) {
  TriangleSource random(5);
  const std::vector<Vec3> a = ball(random, Vec3::Zero(), 500),
                          b = ball(random, 0.1 * Vec3(1, 0.7, 0.3), 500);
  const auto depth = [&](adapters::CcdAlgorithm algorithm) {
    adapters::CcdSettings fine = settings(algorithm);
    fine.epa_tolerance = fine.mpr_tolerance = 1e-12;
    adapters::CcdCaller caller(fine);
    return caller.penetrate(a, b).translation.value().depth;
  };
  EXPECT_THAT(depth(adapters::CcdAlgorithm::kGjk), AllOf(Gt(1.2), Lt(1.5)));
  EXPECT_THAT(depth(adapters::CcdAlgorithm::kMpr), AllOf(Gt(1.86), Lt(1.95)));
}

// Of boxes EPA ends at the face that the shortest way goes through, unless its tolerance, which it
// holds against squares of lengths, ends it before.
TEST(LibccdCall, DepthOfTurnedBoxesIsTheShortestWayByEpaUnlessItsToleranceIsLibccdsOwn) {
  TriangleSource random(7);
  const auto box = [&](const Vec3& center) {
    const TrianglePoints t = random.triangle(Vec3::Zero(), 1);
    Vec3 x = t[0].normalized(), y = (t[1] - x * x.dot(t[1])).normalized();
    Corners out = cuboid(Vec3::Constant(-0.5), Vec3::Ones());
    for (Vec3& p : out)
      p = center + 0.25 * (p.x() * x + 0.5 * p.y() * y + 2.0 * p.z() * x.cross(y));
    return out;
  };
  adapters::CcdSettings coarse = settings(adapters::CcdAlgorithm::kGjk, 100, 0.0), fine = coarse;
  coarse.epa_tolerance = 1e-4;
  std::size_t depths = 0;
  double most_wrong = 0.0, most_wrong_coarse = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double size = std::ldexp(1.0, i % 21 - 10);
    Corners a = box(Vec3::Zero()), b = box(random.point(Vec3::Zero(), 0.3));
    const auto right = [a, b] {
      return oracle::convex_penetration(surface(a), surface(b), 1e-9).depth;
    };
    for (Vec3& p : a) p *= size;
    for (Vec3& p : b) p *= size;
    const auto found = adapters::CcdCaller(fine).penetrate(a, b).translation;
    if (!found) continue;
    ++depths;
    const double depth = right();
    most_wrong = std::max(most_wrong, std::abs(found->depth / size - depth));
    const auto rough = adapters::CcdCaller(coarse).penetrate(a, b).translation;
    if (rough)
      most_wrong_coarse = std::max(most_wrong_coarse, std::abs(rough->depth / size - depth));
  }
  EXPECT_GT(depths, 500u);
  EXPECT_LT(most_wrong, 1e-9);
  EXPECT_GT(most_wrong_coarse, 0.05);
}

TEST(LibccdCall, DepthThatTakesTooLongIsLeftOutOfAContact) {
  TriangleSource random(5);
  const std::vector<Vec3> a = ball(random, Vec3::Zero(), 2000),
                          b = ball(random, 0.3 * Vec3(1, 0.7, 0.3), 2000);
  for (const adapters::CcdAlgorithm algorithm : kBoth) {
    adapters::CcdSettings few = settings(algorithm,
                                         algorithm == adapters::CcdAlgorithm::kGjk ? 10 : 4),
                          many = few;
    few.epa_tolerance = few.mpr_tolerance = many.epa_tolerance = many.mpr_tolerance = 1e-12;
    many.iterations = 10000;
    adapters::CcdCaller limited(few), free(many);
    EXPECT_TRUE(limited.intersect(a, b));
    const adapters::CcdPenetration found = limited.penetrate(a, b);
    EXPECT_TRUE(found.contact);
    EXPECT_FALSE(found.translation);
    EXPECT_EQ(limited.depth_limits(), 1u);
    EXPECT_EQ(limited.verdict_limits(), 0u);
    EXPECT_THAT(limited.notes(), ElementsAre(HasSubstr("contacts without a depth")));
    EXPECT_TRUE(free.penetrate(a, b).translation);
    EXPECT_THAT(free.notes(), IsEmpty());
  }
}

TEST(LibccdCall, NotesAreForgottenWithTheFrameAndCallsAreNot) {
  adapters::CcdCaller caller(settings(adapters::CcdAlgorithm::kMpr));
  caller.intersect(kLoopA, kLoopB);
  const std::uint64_t calls = caller.support_calls();
  caller.begin_frame();
  EXPECT_THAT(caller.notes(), IsEmpty());
  EXPECT_EQ(caller.support_calls(), calls);
}

// Identical, touching, coplanar pairs, segments and points: every call ends, and a penetration says
// the same as the plain call.
TEST(LibccdCall, EndsOnTrianglesOfEveryKindAndAgreesWithItself) {
  for (const adapters::CcdAlgorithm algorithm : kBoth) {
    TriangleSource random(1);
    adapters::CcdCaller caller(settings(algorithm, 100, 1024.0));
    std::size_t hits = 0, true_hits = 0, spurious = 0;
    constexpr int kPairs = 40000;
    for (int i = 0; i < kPairs; ++i) {
      const TrianglePoints a = random.grid_triangle(2);
      const TrianglePoints b = i % 16 == 0 ? a : random.grid_triangle(2);
      const bool touch = caller.intersect(a, b), truth = triangles_intersect(a, b);
      ASSERT_EQ(touch, caller.penetrate(a, b).contact) << i;
      hits += touch;
      true_hits += truth;
      spurious += touch && !truth;
    }
    EXPECT_LT(caller.support_calls(), 16u * kPairs);
    EXPECT_EQ(spurious, 0u);
    EXPECT_THAT(hits, AllOf(Gt(kPairs / 5u), Lt(true_hits)));
    // A fact of libccd 2.1: among so many pairs MPR goes round for ever on a few, GJK on none.
    EXPECT_EQ(caller.verdict_limits() > 0, algorithm == adapters::CcdAlgorithm::kMpr);
  }
}

/// Of pairs of triangles of about this size that intersect, those that are not reported, in percent
/// (rounded up).
std::size_t missed_percent(const adapters::CcdSettings& settings, double size) {
  TriangleSource random(3);
  adapters::CcdCaller caller(settings);
  std::size_t truth = 0, missed = 0;
  for (int i = 0; i < 4000; ++i) {
    TrianglePoints a = random.triangle(random.point(Vec3(0, 0, 0), 0.5), 1);
    TrianglePoints b = random.triangle(random.point(Vec3(0, 0, 0), 0.5), 1);
    for (int k = 0; k < 3; ++k) a[k] *= size, b[k] *= size;
    const bool expected = triangles_intersect(a, b);
    truth += expected;
    missed += expected && !caller.intersect(a, b);
  }
  EXPECT_THAT(truth, AllOf(Gt(500u), Lt(3500u)));
  return (missed * 100 + truth - 1) / truth;
}

// libccd 2.1, prior work C9: GJK ends where the square of a direction, itself of the third power of
// lengths, is below 2.2e-16: at triangles of a few millimetres.
TEST(LibccdCall, GjkIsBlindToTrianglesOfAMillimetreUnlessScaled) {
  EXPECT_EQ(missed_percent(settings(adapters::CcdAlgorithm::kGjk), 1.0), 0u);
  EXPECT_GT(missed_percent(settings(adapters::CcdAlgorithm::kGjk), 1e-3), 80u);
  EXPECT_EQ(missed_percent(settings(adapters::CcdAlgorithm::kGjk, 100, 1024.0), 1e-3), 0u);
}

TEST(LibccdCall, MprLosesWhatIsBelowItsTolerance) {
  adapters::CcdSettings coarse = settings(adapters::CcdAlgorithm::kMpr), fine = coarse;
  coarse.mpr_tolerance = 1e-4;  // its own
  EXPECT_THAT(missed_percent(coarse, 1e-3), AllOf(Gt(0u), Lt(10u)));
  EXPECT_EQ(missed_percent(fine, 1e-3), 0u);
}

TEST(LibccdCall, EpaStopsEarlierByACoarserTolerance) {
  TriangleSource random(5);
  const std::vector<Vec3> a = ball(random, Vec3::Zero(), 500), b = ball(random, Vec3::UnitX(), 500);
  adapters::CcdSettings coarse = settings(adapters::CcdAlgorithm::kGjk);
  coarse.epa_tolerance = 1.0;
  adapters::CcdCaller rough(coarse), fine(settings(adapters::CcdAlgorithm::kGjk));
  EXPECT_LT(rough.penetrate(a, b).translation.value().depth,
            fine.penetrate(a, b).translation.value().depth);
  EXPECT_LT(rough.support_calls(), fine.support_calls());
}

}  // namespace
}  // namespace contactcheck::test
