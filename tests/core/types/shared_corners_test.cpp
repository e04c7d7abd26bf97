#include "core/types/shared_corners.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace contactcheck {
namespace {

// All triangles over few vertices, also those that name one twice.
TEST(SharedCorners, AreThoseOfTheSetsAndComeFirst) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    Triangle p, q;
    for (std::uint32_t& v : p) v = static_cast<std::uint32_t>(random() % 5);
    for (std::uint32_t& v : q) v = static_cast<std::uint32_t>(random() % 5);
    const std::set<std::uint32_t> a(p.begin(), p.end()), b(q.begin(), q.end());
    std::uint32_t common = 0;
    for (const std::uint32_t v : a) common += b.contains(v) ? 1 : 0;
    const SharedCorners shared = shared_corners(p, q);
    ASSERT_EQ(shared.count, common);
    ASSERT_EQ(shared.duplicates, a == b);
    ASSERT_EQ((std::set<int>{shared.p.begin(), shared.p.end()}), (std::set<int>{0, 1, 2}));
    ASSERT_EQ((std::set<int>{shared.q.begin(), shared.q.end()}), (std::set<int>{0, 1, 2}));
    for (std::uint32_t c = 0; c < shared.count; ++c)
      ASSERT_EQ(p[shared.p[c]], q[shared.q[c]]) << "in the same order";
  }
}

}  // namespace
}  // namespace contactcheck
