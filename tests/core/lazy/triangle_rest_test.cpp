// The gap of a triangle is the least of its gaps in bodies of two triangles, it and one other.

#include "core/lazy/triangle_rest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/narrow/adjacent_triangles.h"
#include "tests/core/lazy/bounds_cases.h"

namespace contactcheck::test {
namespace {

using Gaps = std::vector<double>;

// Metres.
Gaps gaps_of(const TriangleMesh& mesh) {
  const auto shape = make_bare_shape(mesh);
  Gaps out;
  for (const TriangleRest& triangle : triangles_at_rest(*shape))
    out.push_back(triangle.gap / rest_scale(*shape));
  return out;
}

Gaps gaps_by_pairs(const TriangleMesh& mesh) {
  Gaps out;
  for (const Triangle& t : mesh.triangles) out.push_back(gaps_of({mesh.vertices, {t}})[0]);
  for (std::size_t s = 0; s < out.size(); ++s)
    for (std::size_t t = 0; t < s; ++t) {
      const Triangle &p = mesh.triangles[s], &q = mesh.triangles[t];
      if (shared_corners(p, q).count > 0 && !shared_corners(p, q).duplicates) continue;
      const Gaps both = gaps_of({mesh.vertices, {p, q}});
      out[s] = std::min(out[s], both[0]);
      out[t] = std::min(out[t], both[1]);
    }
  return out;
}

TriangleMesh loose_triangles(int count, double radius) {
  TriangleSource random(8);
  TriangleMesh out;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (const Vec3& p : random.triangle(random.point(Vec3::Zero(), 1.0), radius))
      out.vertices.push_back(p);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

// Up to rounding: the distance of two triangles is computed in either order.
MATCHER_P(AreNearly, expected, "") {
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (!(std::abs(arg.at(i) - expected[i]) < 1e-12)) return false;
  return arg.size() == expected.size();
}

TEST(TriangleRest, GapsAreThoseOfTheNearestTriangles) {
  for (const TriangleMesh& mesh : {sheet(7), long_triangles(4, 20), loose_triangles(80, 0.02),
                                   loose_triangles(80, 0.2), loose_triangles(80, 1.0)})
    EXPECT_THAT(gaps_of(mesh), AreNearly(gaps_by_pairs(mesh)));
  TriangleMesh twice = sheet(4);
  const std::vector<Triangle> once = twice.triangles;
  twice.triangles.insert(twice.triangles.end(), once.begin(), once.end());
  EXPECT_EQ(gaps_of(twice), Gaps(2 * once.size(), 0.0));
}

// Needles along a diagonal, all of whose boxes overlap: the nearest one cannot be told by boxes.
TEST(TriangleRest, NoGapWhereTooManyAreAbout) {
  TriangleSource random(9);
  TriangleMesh needles;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Vec3 start = random.point(Vec3::Zero(), 1.0), end = start + 100 * Vec3(1, 1, 1);
    for (const Vec3& p : {start, end, Vec3(end + 0.001 * Vec3(1, -1, 0))})
      needles.vertices.push_back(p);
    needles.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Gaps gaps = gaps_of(needles);
  EXPECT_EQ(std::count(gaps.begin(), gaps.end(), 0.0), 3000);
}

}  // namespace
}  // namespace contactcheck::test
