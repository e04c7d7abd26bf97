#include "core/types/vertex_places.h"

#include <gmock/gmock.h>

namespace contactcheck {
namespace {

using ::testing::ElementsAre;

TEST(FirstAtPlace, IsTheLowestOfThoseThatAreEqual) {
  const std::vector<Vec3> vertices = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  EXPECT_THAT(first_at_place(vertices), ElementsAre(0u, 1u, 0u, 3u, 0u));
}

TEST(FirstAtPlace, ZeroHasNoSign) {
  EXPECT_THAT(first_at_place(std::vector<Vec3>{{0.0, -0.0, 2}, {-0.0, 0.0, 2}}),
              ElementsAre(0u, 0u));
}

TEST(FirstAtPlace, NeighbouringDoublesAreTwoPlaces) {
  EXPECT_THAT(first_at_place(std::vector<Vec3>{{1, 0, 0}, {1 + 0x1p-52, 0, 0}}),
              ElementsAre(0u, 1u));
}

}  // namespace
}  // namespace contactcheck
