#include "core/narrow/triangle_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/range_ends.h"

namespace contactcheck {
namespace {

/// Both orders must agree.
bool meet(const TrianglePoints& p, const TrianglePoints& q) {
  const bool result = triangles_intersect(p, q);
  EXPECT_EQ(result, triangles_intersect(q, p)) << "depends on the order";
  return result;
}

TrianglePoints moved(TrianglePoints t, const Vec3& offset) {
  for (Vec3& corner : t) corner += offset;
  return t;
}

TrianglePoints scaled(TrianglePoints t, double factor) {
  for (Vec3& corner : t) corner *= factor;
  return t;
}

/// In the plane z = 0.
const TrianglePoints kBase = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TEST(TrianglesIntersect, PiercingAndPassing) {
  EXPECT_TRUE(meet(kBase, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 1)}));
  EXPECT_TRUE(meet(kBase, {Vec3(1, 1, -1), Vec3(1, 2, 1), Vec3(2, 1, 1)}));
  EXPECT_FALSE(meet(kBase, {Vec3(3, 3, -1), Vec3(3, 3, 1), Vec3(9, 9, 1)}));
  EXPECT_FALSE(meet(kBase, {Vec3(-5, 1, -1), Vec3(-5, 1, 1), Vec3(-1, 1, 1)}));
}

TEST(TrianglesIntersect, Parallel) {
  EXPECT_FALSE(meet(kBase, moved(kBase, Vec3(0, 0, 1))));
  EXPECT_FALSE(meet(kBase, moved(kBase, Vec3(0, 0, test::kSmallestDouble))));
}

TEST(TrianglesIntersect, VertexTouchesVertex) {
  EXPECT_TRUE(meet(kBase, {Vec3(4, 0, 0), Vec3(6, 1, 3), Vec3(7, -1, 2)}));
  EXPECT_FALSE(meet(kBase, {Vec3(std::nextafter(4.0, 5.0), 0, 0), Vec3(6, 1, 3), Vec3(7, -1, 2)}));
}

TEST(TrianglesIntersect, VertexTouchesFace) {
  EXPECT_TRUE(meet(kBase, {Vec3(1, 1, 0), Vec3(1, 2, 3), Vec3(2, 1, 3)}));
  EXPECT_FALSE(meet(kBase, {Vec3(1, 1, test::kSmallestDouble), Vec3(1, 2, 3), Vec3(2, 1, 3)}));
  EXPECT_FALSE(meet(kBase, {Vec3(3, 3, 0), Vec3(1, 2, 3), Vec3(2, 1, 3)}));
}

TEST(TrianglesIntersect, VertexTouchesEdge) {
  EXPECT_TRUE(meet(kBase, {Vec3(2, 2, 0), Vec3(3, 3, 1), Vec3(3, 3, -2)}));
  const double beyond = std::nextafter(2.0, 3.0);
  EXPECT_FALSE(meet(kBase, {Vec3(2, beyond, 0), Vec3(3, 3, 1), Vec3(3, 3, -2)}));
}

TEST(TrianglesIntersect, EdgeTouchesEdge) {
  // No vertex in the other's plane: the two edges meet in (2, 0, 0) only.
  EXPECT_TRUE(meet(kBase, {Vec3(2, 0, -1), Vec3(2, 0, 1), Vec3(2, -3, 2)}));
  const double beside = -test::kSmallestDouble;
  EXPECT_FALSE(meet(kBase, {Vec3(2, beside, -1), Vec3(2, beside, 1), Vec3(2, -3, 2)}));
  EXPECT_TRUE(meet(kBase, {Vec3(1, 3, -1), Vec3(3, 1, 1), Vec3(5, 5, 7)}));
}

TEST(TrianglesIntersect, SharedEdgeAndIdentical) {
  EXPECT_TRUE(meet(kBase, {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(1, -1, 2)}));
  EXPECT_TRUE(meet(kBase, {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(1, -1, 0)}));
  EXPECT_TRUE(meet(kBase, kBase));
  EXPECT_TRUE(meet(kBase, {kBase[2], kBase[1], kBase[0]}));
}

TEST(TrianglesIntersect, CoplanarOverlapContainedTouchingDisjoint) {
  EXPECT_TRUE(meet(kBase, moved(kBase, Vec3(1, 1, 0))));
  EXPECT_TRUE(meet(kBase, {Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(1, 2, 0)}));
  EXPECT_TRUE(meet(kBase, moved(kBase, Vec3(4, 0, 0))));
  EXPECT_TRUE(meet(kBase, {Vec3(2, 2, 0), Vec3(5, 3, 0), Vec3(3, 5, 0)}));
  EXPECT_TRUE(meet(kBase, {Vec3(-1, 5, 0), Vec3(5, -1, 0), Vec3(9, 9, 0)}));
  EXPECT_FALSE(meet(kBase, {Vec3(3, 3, 0), Vec3(5, 3, 0), Vec3(3, 5, 0)}));
  EXPECT_FALSE(meet(kBase, moved(kBase, Vec3(std::nextafter(4.0, 5.0), 0, 0))));
  const double beyond = std::nextafter(2.0, 3.0);
  EXPECT_FALSE(meet(kBase, {Vec3(2, beyond, 0), Vec3(5, 3, 0), Vec3(3, 5, 0)}));
}

TEST(TrianglesIntersect, CoplanarStarWithoutAVertexInside) {
  const TrianglePoints up = {Vec3(-3, -2, 1), Vec3(3, -2, 1), Vec3(0, 4, 1)};
  const TrianglePoints down = {Vec3(-3, 2, 1), Vec3(3, 2, 1), Vec3(0, -4, 1)};
  EXPECT_TRUE(meet(up, down));
}

TEST(TrianglesIntersect, CoplanarInATiltedPlane) {
  // The plane x + y + z = 3 in all three projections.
  const TrianglePoints t = {Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 3)};
  EXPECT_TRUE(meet(t, {Vec3(1, 1, 1), Vec3(4, -2, 1), Vec3(4, -4, 3)}));
  EXPECT_FALSE(meet(t, {Vec3(4, 0, -1), Vec3(4, -2, 1), Vec3(5, -2, 0)}));
  const double off = std::nextafter(1.0, 2.0);
  EXPECT_FALSE(meet(t, {Vec3(1, 1, off), Vec3(4, -2, off), Vec3(4, -4, 4)}));
}

TEST(TrianglesIntersect, SegmentTriangle) {
  const Vec3 a(1, 1, -1), b(1, 1, 1), middle(1, 1, 0.5);
  EXPECT_TRUE(meet(kBase, {a, b, a}));
  EXPECT_TRUE(meet(kBase, {a, middle, b}));
  EXPECT_TRUE(meet(kBase, {middle, b, a}));
  EXPECT_FALSE(meet(kBase, {middle, b, middle}));
  EXPECT_TRUE(meet(kBase, {Vec3(-1, 1, 0), Vec3(9, 1, 0), Vec3(3, 1, 0)}));
  EXPECT_FALSE(meet(kBase, {Vec3(-1, 5, 0), Vec3(9, 5, 0), Vec3(3, 5, 0)}));
}

TEST(TrianglesIntersect, TwoSegments) {
  const TrianglePoints s = {Vec3(0, 0, 0), Vec3(2, 2, 2), Vec3(1, 1, 1)};
  EXPECT_TRUE(meet(s, {Vec3(2, 0, 1), Vec3(0, 2, 1), Vec3(2, 0, 1)}));
  EXPECT_TRUE(meet(s, {Vec3(2, 2, 2), Vec3(5, 5, 5), Vec3(3, 3, 3)}));
  EXPECT_FALSE(meet(s, {Vec3(3, 3, 3), Vec3(5, 5, 5), Vec3(4, 4, 4)}));
  EXPECT_FALSE(meet(s, {Vec3(2, 0, 1), Vec3(0, 2, 1.5), Vec3(2, 0, 1)}));
}

TEST(TrianglesIntersect, PointTriangle) {
  const auto point = [](const Vec3& p) { return TrianglePoints{p, p, p}; };
  EXPECT_TRUE(meet(kBase, point(Vec3(1, 1, 0))));
  EXPECT_TRUE(meet(kBase, point(Vec3(2, 2, 0))));
  EXPECT_FALSE(meet(kBase, point(Vec3(1, 1, test::kSmallestDouble))));
  EXPECT_FALSE(meet(kBase, point(Vec3(3, 3, 0))));
  const TrianglePoints s = {Vec3(0, 0, 0), Vec3(2, 2, 2), Vec3(1, 1, 1)};
  EXPECT_TRUE(meet(s, point(Vec3(1.5, 1.5, 1.5))));
  EXPECT_FALSE(meet(s, point(Vec3(1.5, 1.5, 1.25))));
  EXPECT_TRUE(meet(point(Vec3(7, 8, 9)), point(Vec3(7, 8, 9))));
  EXPECT_TRUE(meet(point(Vec3(0.0, 8, 9)), point(Vec3(-0.0, 8, 9))));
  EXPECT_FALSE(meet(point(Vec3(7, 8, 9)), point(Vec3(7, 8, std::nextafter(9.0, 10.0)))));
}

TEST(TrianglesIntersect, Slivers) {
  const double thin = 0x1p-40;
  const TrianglePoints sliver = {Vec3(-8, 1, -1), Vec3(8, 1, 1), Vec3(8, 1 + thin, 1)};
  EXPECT_TRUE(meet(kBase, sliver));
  EXPECT_FALSE(meet(kBase, moved(sliver, Vec3(0, 3, 0.5))));
  EXPECT_FALSE(meet(kBase, moved(sliver, Vec3(0, -1 - 2 * thin, 0))));
}

struct ScaledCase {
  TrianglePoints p, q;
  bool expected;
};

/// Small integers, so that every scaling by a power of two or to whole denormals is exact.
std::vector<ScaledCase> scaled_cases() {
  return {{kBase, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 1)}, true},
          {kBase, {Vec3(3, 3, -1), Vec3(3, 3, 1), Vec3(9, 9, 1)}, false},
          {kBase, {Vec3(2, 2, 0), Vec3(3, 3, 1), Vec3(3, 3, -2)}, true},
          {kBase, {Vec3(2, 0, -1), Vec3(2, 0, 1), Vec3(2, -3, 2)}, true},
          {kBase, {Vec3(3, 3, 0), Vec3(5, 3, 0), Vec3(3, 5, 0)}, false},
          {kBase, {Vec3(1, 1, 1), Vec3(1, 2, 3), Vec3(2, 1, 3)}, false},
          {kBase, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 1, 0)}, true},
          {{Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 3)},
           {Vec3(1, 1, 1), Vec3(4, -2, 1), Vec3(4, -4, 3)},
           true}};
}

TEST(TrianglesIntersect, SameAnswersAtEveryScale) {
  for (double scale :
       {test::kSmallestDouble, 1e-320, 1e-160, 1e-104, 1e-9, 1.0, 1e9, 1e100, 1e160, 1e307}) {
    const double power = scale < 1e-300 ? scale : std::exp2(std::floor(std::log2(scale)));
    for (const ScaledCase& c : scaled_cases())
      EXPECT_EQ(meet(scaled(c.p, power), scaled(c.q, power)), c.expected) << scale;
  }
}

TEST(TrianglesIntersect, SameAnswersAtAFarOffset) {
  for (const ScaledCase& c : scaled_cases())
    for (const Vec3& offset : {Vec3(1e6, 0, 0), Vec3(1e6, -1e6, 1e6), Vec3(-1e9, 1e9, 1e9)})
      EXPECT_EQ(meet(moved(c.p, offset), moved(c.q, offset)), c.expected) << offset.transpose();
}

TEST(TrianglesIntersect, LibiglIssue2381IsDisjoint) {
  // libigl #2381: Guigue and Devillers' test in plain doubles calls this pair a hit.
  const TrianglePoints p = {Vec3(0.38924700021743752, 0.38563750684261300, 0.45762349665164948),
                            Vec3(0.39279749989509577, 0.37299175560474374, 0.45553924888372399),
                            Vec3(0.38769650459289529, 0.38623825460672351, 0.46271274238824822)};
  const TrianglePoints q = {Vec3(0.39234799146652199, 0.38443601131439198, 0.44744500517845198),
                            Vec3(0.39079749584197976, 0.38503675907850249, 0.45253425091505073),
                            Vec3(0.38700349628925301, 0.38789276033639897, 0.45634675025939975)};
  EXPECT_FALSE(meet(p, q));
  EXPECT_FALSE(meet(scaled(p, 10.0), scaled(q, 10.0)));
}

}  // namespace
}  // namespace contactcheck
