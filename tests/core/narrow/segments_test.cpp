#include "core/narrow/segments.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contactcheck {
namespace {

const Vec3 kZero(0, 0, 0);

Segment segment(const Vec3& a, const Vec3& b) { return ordered_segment(a, b); }

/// In the plane z = 0, with corners (0,0), (4,0), (0,4).
const ProperTriangle kTriangle{{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)}, 2};

TEST(Before, ComparesCoordinatesInOrder) {
  EXPECT_TRUE(before(Vec3(0, 9, 9), Vec3(1, 0, 0)));
  EXPECT_TRUE(before(Vec3(0, 0, 9), Vec3(0, 1, 0)));
  EXPECT_TRUE(before(Vec3(0, 0, 0), Vec3(0, 0, 1)));
  EXPECT_FALSE(before(kZero, kZero));
  EXPECT_FALSE(before(Vec3(0.0, 0, 0), Vec3(-0.0, 0, 0)));
}

TEST(PointOnSegment, EndsInsideBeyondAndBeside) {
  const Segment s = segment(Vec3(3, 6, 9), Vec3(1, 2, 3));
  EXPECT_TRUE(point_on_segment(Vec3(1, 2, 3), s));
  EXPECT_TRUE(point_on_segment(Vec3(3, 6, 9), s));
  EXPECT_TRUE(point_on_segment(Vec3(2, 4, 6), s));
  EXPECT_FALSE(point_on_segment(Vec3(4, 8, 12), s));
  EXPECT_FALSE(point_on_segment(Vec3(0, 0, 0), s));
  EXPECT_FALSE(point_on_segment(Vec3(2, 4, std::nextafter(6.0, 7.0)), s));
}

TEST(PointOnTriangle, CornerEdgeFaceOutsideAndOffThePlane) {
  EXPECT_TRUE(point_on_triangle(Vec3(4, 0, 0), kTriangle));
  EXPECT_TRUE(point_on_triangle(Vec3(2, 2, 0), kTriangle));
  EXPECT_TRUE(point_on_triangle(Vec3(1, 1, 0), kTriangle));
  EXPECT_FALSE(point_on_triangle(Vec3(2, std::nextafter(2.0, 3.0), 0), kTriangle));
  EXPECT_FALSE(point_on_triangle(Vec3(1, 1, 5e-324), kTriangle));
  EXPECT_FALSE(point_on_triangle(Vec3(5, 0, 0), kTriangle));
}

TEST(SegmentsMeet, CrossingTouchingAndSkew) {
  const Segment s = segment(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  EXPECT_TRUE(segments_meet(s, segment(Vec3(1, -1, 0), Vec3(-1, 1, 0))));
  EXPECT_TRUE(segments_meet(s, segment(kZero, Vec3(0, 0, 7))));
  EXPECT_TRUE(segments_meet(s, segment(Vec3(1, 1, 1), Vec3(0, 0, 7))));
  EXPECT_FALSE(segments_meet(s, segment(Vec3(1, -1, 0), Vec3(-1, 1, 5e-324))));
  EXPECT_FALSE(segments_meet(s, segment(Vec3(2, 2, 2), Vec3(0, 0, 7))));
  EXPECT_FALSE(segments_meet(s, segment(Vec3(-1, -1, 0), Vec3(1, 1, 2))));
}

TEST(SegmentsMeet, CollinearOverlapTouchAndGap) {
  const Segment s = segment(kZero, Vec3(2, 4, 6));
  EXPECT_TRUE(segments_meet(s, segment(Vec3(1, 2, 3), Vec3(5, 10, 15))));
  EXPECT_TRUE(segments_meet(s, segment(Vec3(2, 4, 6), Vec3(5, 10, 15))));
  EXPECT_TRUE(segments_meet(segment(Vec3(-1, -2, -3), Vec3(5, 10, 15)), s));
  EXPECT_FALSE(segments_meet(s, segment(Vec3(3, 6, 9), Vec3(5, 10, 15))));
  EXPECT_FALSE(segments_meet(segment(Vec3(3, 6, 9), Vec3(5, 10, 15)), s));
}

TEST(SegmentMeetsTriangle, PiercingTouchingAndPassing) {
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(1, 1, -1), Vec3(1, 1, 1)), kTriangle));
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(1, 1, 0), Vec3(1, 1, 1)), kTriangle));
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(2, 2, -1), Vec3(2, 2, 1)), kTriangle));
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(0, 0, -1), Vec3(0, 0, 1)), kTriangle));
  EXPECT_FALSE(segment_meets_triangle(segment(Vec3(3, 3, -1), Vec3(3, 3, 1)), kTriangle));
  EXPECT_FALSE(segment_meets_triangle(segment(Vec3(1, 1, 1), Vec3(1, 1, 2)), kTriangle));
  EXPECT_FALSE(segment_meets_triangle(segment(Vec3(1, 1, 5e-324), Vec3(1, 1, 2)), kTriangle));
}

TEST(SegmentMeetsTriangle, InThePlane) {
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(1, 1, 0), Vec3(2, 1, 0)), kTriangle));
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(-1, 1, 0), Vec3(9, 1, 0)), kTriangle));
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(-1, 1, 0), Vec3(1, 1, 0)), kTriangle));
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(4, 0, 0), Vec3(9, 0, 0)), kTriangle));
  EXPECT_TRUE(segment_meets_triangle(segment(Vec3(5, -1, 0), Vec3(-1, 5, 0)), kTriangle));
  EXPECT_FALSE(segment_meets_triangle(segment(Vec3(5, 0, 0), Vec3(9, 0, 0)), kTriangle));
  EXPECT_FALSE(segment_meets_triangle(segment(Vec3(5, 0, 0), Vec3(0, 5, 0)), kTriangle));
}

}  // namespace
}  // namespace contactcheck
