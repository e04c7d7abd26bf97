// core/narrow, and the filter of core/lazy before it, against the rational judge at the ends of the
// range of doubles: there differences overflow, products underflow, and exact arithmetic decides.

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "core/lazy/kernels.h"
#include "core/narrow/predicates.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/support/range_ends.h"

namespace contactcheck::test {
namespace {

using MakePair = TrianglePair (RangeEndSource::*)();

struct EndName {
  RangeEnd end;
  const char* name;
};
constexpr EndName kEnds[] = {
    {RangeEnd::kLargest, "largest"}, {RangeEnd::kDenormal, "denormal"}, {RangeEnd::kBoth, "both"}};

std::string describe_pair(const TrianglePair& pair) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const TrianglePoints* t : {&pair.first, &pair.second})
    for (const Vec3& c : *t) out << "Vec3(" << c.x() << ", " << c.y() << ", " << c.z() << "), ";
  return out.str();
}

/// Every predicate on four of the pair's corners; returns the true side.
int check_predicates(const TrianglePair& pair) {
  const auto& [a, b, c] = pair.first;
  const Vec3& d = pair.second[0];
  const int expected = oracle::rational::orient3d(a, b, c, d);
  EXPECT_EQ(orient3d(a, b, c, d), expected) << describe_pair(pair);
  EXPECT_EQ(orient3d_exact(a, b, c, d), expected) << describe_pair(pair);
  for (int axis = 0; axis < 3; ++axis) {
    const int area = oracle::rational::orient2d(a, b, d, axis);
    EXPECT_EQ(orient2d(a, b, d, axis), area) << axis << ' ' << describe_pair(pair);
    EXPECT_EQ(orient2d_exact(a, b, d, axis), area) << axis << ' ' << describe_pair(pair);
  }
  return expected;
}

/// Compares pairs one by one and, eight at a time, what the filter says of them on every
/// instruction set.
class PairJudge {
 public:
  void check(const TrianglePair& pair) {
    const auto& [p, q] = pair;
    const bool expected = oracle::rational::triangles_intersect(p, q);
    EXPECT_EQ(triangles_intersect(p, q), expected) << describe_pair(pair);
    EXPECT_EQ(triangles_intersect(q, p), expected) << describe_pair(pair);
    hits_ += expected;
    truth_ |= std::uint32_t{expected} << batch_.count;
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis) {
        batch_.corner[0][c][axis][batch_.count] = p[index(c)][axis];
        batch_.corner[1][c][axis][batch_.count] = q[index(c)][axis];
      }
    if (++batch_.count == kBatchWidth) check_batch();
  }
  int hits() const { return hits_; }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  void check_batch() {
    for (const std::string& isa : lazy_isas()) {
      const BatchVerdict verdict = lazy_kernels(isa).test_batch(batch_);
      const std::uint32_t invented = verdict.meet & ~truth_;
      const std::uint32_t denied = truth_ & ~(verdict.meet | verdict.unknown);
      EXPECT_EQ(invented | denied, 0u) << isa << ": " << describe_lanes(invented | denied);
    }
    batch_.count = 0;
    truth_ = 0;
  }

  std::string describe_lanes(std::uint32_t lanes) const {
    std::string out;
    for (std::size_t lane = 0; lane < kBatchWidth; ++lane)
      if (lanes >> lane & 1) out += describe_pair({batch_.points(0, lane), batch_.points(1, lane)});
    return out;
  }

  TriangleBatch batch_{};
  std::uint32_t truth_ = 0;  ///< bit i: the pair in lane i meets
  int hits_ = 0;
};

/// @pre count is a multiple of kBatchWidth: a batch that is not full is never tested
void check_pairs(std::uint64_t seed, int count, MakePair make) {
  for (const EndName& e : kEnds) {
    SCOPED_TRACE(e.name);
    RangeEndSource source(seed, e.end);
    PairJudge judge;
    for (int i = 0; i < count; ++i) judge.check((source.*make)());
    EXPECT_GT(10 * judge.hits(), count);
    EXPECT_LT(10 * judge.hits(), 9 * count);
  }
}

TEST(PredicatesAtTheEndsOfTheRange, AgreeWithRationals) {
  constexpr MakePair kMakers[] = {&RangeEndSource::free_pair, &RangeEndSource::sharing_pair,
                                  &RangeEndSource::flat_pair, &RangeEndSource::lattice_pair};
  for (const EndName& e : kEnds) {
    SCOPED_TRACE(e.name);
    RangeEndSource source(81, e.end);
    int zeros = 0;
    for (int i = 0; i < 2000; ++i) zeros += check_predicates((source.*kMakers[i % 4])()) == 0;
    EXPECT_GT(zeros, 400);
    EXPECT_LT(zeros, 1200);
  }
}

/// Differences of twice the largest double, in units of the smallest: 99 limbs, the most that any
/// determinant needs. The rows are (2 2 1), (1 2 2), (2 1 2) times the largest double, give or take
/// some of the smallest, so that all limbs are in use.
TEST(PredicatesAtTheEndsOfTheRange, AgreeWithRationalsOnTheWidestIntegers) {
  const double m = kLargestDouble, tiny = kSmallestDouble;
  const Vec3 a(-m, -m, -m), b(m, m, tiny), c(-tiny, m, m), d(m, 3 * tiny, m);
  for (const TrianglePair& pair :
       {TrianglePair{{a, b, c}, {d, d, d}}, TrianglePair{{-a, -b, -c}, {-d, -d, -d}},
        TrianglePair{{a, c, b}, {d, d, d}}, TrianglePair{{b, c, d}, {a, a, a}}})
    EXPECT_NE(check_predicates(pair), 0);
}

TEST(TrianglesAtTheEndsOfTheRange, Free) { check_pairs(82, 600, &RangeEndSource::free_pair); }

TEST(TrianglesAtTheEndsOfTheRange, SharingCorners) {
  check_pairs(83, 400, &RangeEndSource::sharing_pair);
}

TEST(TrianglesAtTheEndsOfTheRange, InOnePlaneOrAnUlpOffIt) {
  check_pairs(84, 800, &RangeEndSource::flat_pair);
}

TEST(TrianglesAtTheEndsOfTheRange, OnALattice) {
  check_pairs(85, 1000, &RangeEndSource::lattice_pair);
}

}  // namespace
}  // namespace contactcheck::test
