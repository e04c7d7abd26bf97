#include "core/broad/adjacent_pairs.h"

#include <gmock/gmock.h>

#include <random>

#include "core/types/check.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

void expect_all(const std::vector<Triangle>& triangles) {
  const std::vector<AdjacentPair> found = adjacent_pairs(triangles);
  std::size_t next = 0;
  for (std::uint32_t a = 0; a < triangles.size(); ++a)
    for (std::uint32_t b = a + 1; b < triangles.size(); ++b) {
      const SharedCorners shared = shared_corners(triangles[a], triangles[b]);
      if (shared.count == 0 || shared.duplicates) continue;
      ASSERT_LT(next, found.size());
      EXPECT_EQ(found[next].a, a);
      EXPECT_EQ(found[next].b, b);
      EXPECT_EQ(found[next].shared.count, shared.count);
      ++next;
    }
  EXPECT_EQ(next, found.size());
}

TEST(AdjacentPairs, OfASphere) { expect_all(test::sphere_mesh(Vec3::Zero(), 1.0, 3).triangles); }

TEST(AdjacentPairs, OfTrianglesAtRandom) {
  std::mt19937_64 random(1);
  for (const std::uint32_t vertices : {1u, 3u, 6u, 40u}) {
    std::vector<Triangle> triangles(120);
    for (Triangle& t : triangles)
      for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random() % vertices);
    expect_all(triangles);
  }
}

TEST(AdjacentPairs, AreRefusedWhereThereAreTooMany) {
  std::vector<Triangle> fan;
  for (std::uint32_t i = 0; i < 10'000; ++i) fan.push_back({0, i + 1, i + 2});
  try {
    adjacent_pairs(fan);
    FAIL();
  } catch (const RefusedInput& e) {
    EXPECT_STREQ(e.what(),
                 "its triangles share a vertex in 50004999 pairs (vertex 0 is in 10000 triangles); "
                 "self-contact is judged of at most 40000000");
  }
}

}  // namespace
}  // namespace contactcheck
