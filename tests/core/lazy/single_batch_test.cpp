// Eight pairs of triangles at a time in floats: what the lanes say is what triangles_intersect()
// says exactly of the same floats, and on every instruction set the same is left to it.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "core/lazy/kernels.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using test::TriangleSource;
using Floats = TrianglePointsOf<float>;
using Pair = std::pair<Floats, Floats>;
using MakePair = std::function<Pair(TriangleSource&)>;

Floats floats(const TrianglePoints& t, double scale = 1.0, const Vec3& at = Vec3::Zero()) {
  Floats out;
  for (std::size_t c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) out[c][k] = static_cast<float>(scale * t[c][k] + at[k]);
  return out;
}

void set_lane(SingleTriangleBatch& batch, std::size_t lane, const Pair& pair) {
  for (std::size_t c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) {
      batch.corner[0][c][k][lane] = pair.first[c][k];
      batch.corner[1][c][k][lane] = pair.second[c][k];
    }
}

struct Tally {
  int pairs = 0, met = 0, unknown = 0;
};

std::string wrong(const BatchVerdict& verdict, const std::vector<Pair>& pairs, Tally& tally) {
  if ((verdict.meet | verdict.unknown) >> pairs.size() != 0) return "lanes beyond the last";
  if ((verdict.meet & verdict.unknown) != 0) return "certain and unknown at once";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool truth = triangles_intersect(pairs[i].first, pairs[i].second);
    const bool meet = verdict.meet >> i & 1, unknown = verdict.unknown >> i & 1;
    ++tally.pairs, tally.met += truth, tally.unknown += unknown;
    if (!unknown && meet != truth) return "other than the exact test";
  }
  return "";
}

// `rounds` batches of 1 to 8 pairs. Lanes beyond the last hold what earlier batches left there, or
// no numbers at all.
Tally judge(std::uint64_t seed, int rounds, const MakePair& make) {
  TriangleSource random(seed);
  Tally tally;
  SingleTriangleBatch batch{};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t lane = 0; lane < kBatchWidth; ++lane)
    set_lane(batch, lane, {{Vec3f::Constant(nan), Vec3f::Zero(), Vec3f::Ones()}, {}});
  for (int round = 0; round < rounds; ++round) {
    std::vector<Pair> pairs(static_cast<std::size_t>(1 + round % 8));
    for (std::size_t i = 0; i < pairs.size(); ++i) set_lane(batch, i, pairs[i] = make(random));
    batch.count = pairs.size();
    const BatchVerdict first = lazy_kernels().test_single_batch(batch);
    const std::string text = wrong(first, pairs, tally);
    EXPECT_EQ(text, "") << "seed " << seed << " round " << round;
    for (const std::string& isa : lazy_isas()) {
      const BatchVerdict verdict = lazy_kernels(isa).test_single_batch(batch);
      EXPECT_EQ(verdict.meet, first.meet) << isa << " seed " << seed << " round " << round;
      EXPECT_EQ(verdict.unknown, first.unknown) << isa << " seed " << seed << " round " << round;
    }
  }
  return tally;
}

TEST(SingleTriangleBatch, DecidesGenericPairsAsTheExactTestDoes) {
  for (double scale : {1e-6, 1.0, 1e9}) {
    const Tally tally = judge(641, 1500, [&](TriangleSource& random) -> Pair {
      return {floats(random.triangle(Vec3::Zero(), 1.0), scale),
              floats(random.triangle(Vec3::Zero(), 1.0), scale)};
    });
    EXPECT_LT(1000 * tally.unknown, tally.pairs) << scale;
    EXPECT_GT(5 * tally.met, tally.pairs / 2) << scale;
    EXPECT_LT(5 * tally.met, 4 * tally.pairs) << scale;
  }
}

// Few digits are left of the triangles: many corners coincide, and many determinants are 0.
TEST(SingleTriangleBatch, AgreesWhereFewDigitsAreLeft) {
  for (double offset : {1e2, 1e5, 1e7}) {
    const Tally tally = judge(642, 600, [&](TriangleSource& random) -> Pair {
      const Vec3 at(offset, -offset, 0.3 * offset);
      return {floats(random.triangle(Vec3::Zero(), 1.0), 1.0, at),
              floats(random.triangle(Vec3::Zero(), 1.0), 1.0, at)};
    });
    EXPECT_GT(tally.met, 100) << offset;
  }
}

TEST(SingleTriangleBatch, AgreesWhereCornersAreSingleUlpsFromFeatures) {
  const Tally tally = judge(643, 1200, [](TriangleSource& random) -> Pair {
    const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
    return {floats(t), floats(random.near_degenerate_partner(t, 1.0))};
  });
  EXPECT_GT(20 * tally.unknown, tally.pairs);
}

TEST(SingleTriangleBatch, AgreesOnGridsOfTouchingAndDegenerateTriangles) {
  for (int limit : {1, 2, 4})
    for (double scale : {0x1p-149, 0x1p-60, 1.0, 0x1p38}) {
      const Tally tally = judge(644, 300, [&](TriangleSource& random) -> Pair {
        return {floats(random.grid_triangle(limit), scale),
                floats(random.grid_triangle(limit), scale)};
      });
      EXPECT_GT(20 * tally.unknown, tally.pairs) << limit << " " << scale;
    }
}

// Nearly in one plane: a float's sign is noise, and is not believed.
TEST(SingleTriangleBatch, BelievesNoSignInOneTiltedPlane) {
  const Tally tally = judge(647, 600, [](TriangleSource& random) -> Pair {
    const Vec3 u = random.point(Vec3::Zero(), 1.0), v = random.point(Vec3::Zero(), 1.0);
    const auto in_plane = [&](double from) {
      const auto corner = [&] {
        const Vec3 at = random.point(Vec3(from, 0, 0), 0.5);
        return Vec3(at.x() * u + at.y() * v);
      };
      return floats({corner(), corner(), corner()});
    };
    return {in_plane(0.0), in_plane(0.6)};
  });
  EXPECT_GT(2 * tally.unknown, tally.pairs) << "there is noise";
  EXPECT_LT(2 * tally.met, tally.pairs);
}

TEST(SingleTriangleBatch, AgreesOnNeedles) {
  for (double width : {0x1p-149, 1e-20, 1e-7, 1e-4})
    judge(645, 200, [&](TriangleSource& random) -> Pair {
      const auto needle = [&] {
        const Vec3 a = random.point(Vec3::Zero(), 1.0), b = random.point(Vec3::Zero(), 1.0);
        return floats({a, b, Vec3(a + random.point(Vec3::Zero(), width))});
      };
      return {needle(), needle()};
    });
}

TEST(SingleTriangleBatch, SeesCommonCorners) {
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) {
      const Tally tally = judge(646, 100, [&](TriangleSource& random) -> Pair {
        Pair pair = {floats(random.triangle(Vec3::Zero(), 1.0)),
                     floats(random.triangle(Vec3::Zero(), 1.0))};
        pair.second[static_cast<std::size_t>(q)] = pair.first[static_cast<std::size_t>(p)];
        return pair;
      });
      EXPECT_EQ(tally.met, tally.pairs);
      EXPECT_EQ(tally.unknown, 0);
    }
}

}  // namespace
}  // namespace contactcheck
