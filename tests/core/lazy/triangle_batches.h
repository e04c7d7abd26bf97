// Batches of eight pairs of triangles, of doubles or of floats, held against the exact test.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/lazy/kernels.h"
#include "core/lazy/triangle_batch.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {

using DoublePair = std::pair<TrianglePoints, TrianglePoints>;

// What stands for the range and the digits of either precision.
template <typename Real>
struct Ranges {
  std::vector<double> decided = {1e-60, 1e-30, 1e-9, 1.0, 1e9, 1e80};  // scales of the filter
  std::vector<double> scales = {0x1p-1074, 1e-310, 1e-300, 1e-160, 1e-9, 1.0, 1e100, 1e160, 1e300};
  std::vector<double> offsets = {0.0, 1.0, -1e6, 1e12};
  std::vector<double> few_digits = {1e11, 1e14, 4e15};  // offsets that leave a triangle these
  std::vector<double> sizes = {1e-12, 1e-6, 1e6, 1e150};
  std::vector<double> widths = {0x1p-1074, 1e-200, 1e-17, 1e-12};
  std::vector<double> gaps = {0.0, 1e-17, 1e-16, 1e-15, 1e-12, 1e-6};
  std::vector<double> powers = {0x1p-1070, 0x1p-332, 0x1p-100, 1.0, 0x1p100, 0x1p300};
  double farthest = 0x1p1000;  // products are infinite and no numbers
  std::vector<double> grids = {0x1p-1070, 0x1p-332, 1.0, 0x1p300, 0x1p1000};
  std::vector<int> underflow = {-360, -354, -348, -342, -336, -330};  // of products of three
  std::vector<int> tiny = {-900, -600, -300}, huge = {520, 600, 700};
};
template <>
struct Ranges<float> {
  std::vector<double> decided = {1e-6, 1.0, 1e9};
  std::vector<double> scales = {0x1p-149, 1e-40, 1e-30, 1e-9, 1.0, 1e6, 0x1p38};
  std::vector<double> offsets = {0.0, 1.0, -1e3, 1e6};
  std::vector<double> few_digits = {1e2, 1e5, 1e7};
  std::vector<double> sizes = {1e-12, 1e-6, 1e6, 1e11};
  std::vector<double> widths = {0x1p-149, 1e-20, 1e-7, 1e-4};
  std::vector<double> gaps = {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-3};
  std::vector<double> powers = {0x1p-140, 0x1p-40, 1.0, 0x1p20, 0x1p36};
  double farthest = 0x1p37;  // times 8: kSingleLimit
  // At 0x1p38 those of limit 4 have corners at kSingleLimit, and differences twice as large.
  std::vector<double> grids = {0x1p-149, 0x1p-60, 1.0, 0x1p38};
  std::vector<int> underflow = {-60, -53, -49, -45, -39, -33};
  std::vector<int> tiny = {-145, -100, -50}, huge = {20, 30, 38};
};

struct Tally {
  int pairs = 0, met = 0, unknown = 0;
};

template <typename Real>
class TriangleBatches : public ::testing::Test {
 protected:
  using Points = TrianglePointsOf<Real>;
  using Pair = std::pair<Points, Points>;
  using Batch = TriangleBatchOf<Real>;
  const Ranges<Real> ranges;

  static Points rounded(const TrianglePoints& t) {
    Points out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = t[c].template cast<Real>();
    return out;
  }
  static Pair rounded(const DoublePair& pair) {
    return {rounded(pair.first), rounded(pair.second)};
  }

  static void set_lane(Batch& batch, std::size_t lane, const Pair& pair) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) {
        batch.corner[0][c][k][lane] = pair.first[c][k];
        batch.corner[1][c][k][lane] = pair.second[c][k];
      }
  }

  static BatchVerdict tested(const LazyKernels& kernels, const Batch& batch) {
    if constexpr (std::is_same_v<Real, float>) {
      return kernels.test_single_batch(batch);
    } else {
      return kernels.test_batch(batch);
    }
  }

  // What a verdict says about `pairs`, whose first corners are shared, against the truth; "" or
  // what is wrong.
  static std::string wrong(const BatchVerdict& verdict, const std::vector<Pair>& pairs,
                           std::uint32_t shared, Tally& tally) {
    SharedCorners first;
    first.count = shared;
    if ((verdict.meet | verdict.unknown) >> pairs.size() != 0) return "lanes beyond the last";
    if ((verdict.meet & verdict.unknown) != 0) return "certain and unknown at once";
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const bool truth = meet_beyond_shared(first, pairs[i].first, pairs[i].second);
      const bool meet = verdict.meet >> i & 1, unknown = verdict.unknown >> i & 1;
      ++tally.pairs, tally.met += truth, tally.unknown += unknown;
      if (!unknown && meet != truth) return truth ? "a contact denied" : "a contact invented";
    }
    return "";
  }

  // `rounds` batches of 1 to 8 random pairs, on every instruction set, which must agree bit for
  // bit. Lanes beyond the last hold what earlier batches left there, or no numbers at all.
  template <typename MakePair>
  static Tally judge(std::uint64_t seed, int rounds, const MakePair& make,
                     std::uint32_t shared = 0) {
    TriangleSource random(seed);
    Tally tally;
    Batch batch{};
    batch.shared = shared;
    const Real nan = std::numeric_limits<Real>::quiet_NaN();
    using Point = Vec3Of<Real>;
    for (std::size_t lane = 0; lane < kBatchWidth; ++lane)
      set_lane(batch, lane, {{Point::Constant(nan), Point::Zero(), Point::Ones()}, {}});
    for (int round = 0; round < rounds; ++round) {
      std::vector<Pair> pairs(static_cast<std::size_t>(1 + round % 8));
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i] = rounded(DoublePair(make(random)));
        for (std::uint32_t c = 0; c < shared; ++c) pairs[i].second[c] = pairs[i].first[c];
        set_lane(batch, i, pairs[i]);
      }
      batch.count = pairs.size();
      const BatchVerdict first = tested(lazy_kernels(), batch);
      const std::string text = wrong(first, pairs, shared, tally);
      EXPECT_EQ(text, "") << "seed " << seed << " round " << round;
      for (const std::string& isa : lazy_isas()) {
        const BatchVerdict verdict = tested(lazy_kernels(isa), batch);
        EXPECT_EQ(verdict.meet, first.meet) << isa << " seed " << seed << " round " << round;
        EXPECT_EQ(verdict.unknown, first.unknown) << isa << " seed " << seed << " round " << round;
      }
    }
    return tally;
  }

  // One pair alone, in each lane of each instruction set, at `scales`, powers of two.
  template <typename Check>
  static void in_every_lane(const std::vector<double>& scales, const std::vector<DoublePair>& pairs,
                            const Check& check);
};

inline DoublePair moved(DoublePair pair, double scale, const Vec3& offset) {
  for (TrianglePoints* t : {&pair.first, &pair.second})
    for (Vec3& p : *t) p = scale * p + offset;
  return pair;
}

template <typename Real>
template <typename Check>
void TriangleBatches<Real>::in_every_lane(const std::vector<double>& scales,
                                          const std::vector<DoublePair>& pairs,
                                          const Check& check) {
  for (const std::string& isa : lazy_isas())
    for (double scale : scales)
      for (std::size_t lane = 0; lane < kBatchWidth; ++lane)
        for (const DoublePair& pair : pairs) {
          Batch batch{};
          set_lane(batch, lane, rounded(moved(pair, scale, Vec3::Zero())));
          batch.count = lane + 1;
          ASSERT_TRUE(triangles_intersect(batch.points(0, lane), batch.points(1, lane)));
          SCOPED_TRACE(isa + " " + std::to_string(lane) + " " + std::to_string(std::log2(scale)));
          check(tested(lazy_kernels(isa), batch), lane);
        }
}

}  // namespace contactcheck::test
