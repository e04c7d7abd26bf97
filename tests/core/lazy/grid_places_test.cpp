#include "core/lazy/grid_places.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace contactcheck {
namespace {

// Every position within one of those in the list is asked for: it is where the list has it, or not
// there.
void expect_places(const std::vector<GridIndex>& list) {
  const GridPlaces places(list);
  for (std::uint32_t i = 0; i < list.size(); ++i)
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const GridIndex at = {list[i][0] + static_cast<std::uint32_t>(x),
                                list[i][1] + static_cast<std::uint32_t>(y),
                                list[i][2] + static_cast<std::uint32_t>(z)};
          std::uint32_t wanted = GridPlaces::kNone;
          for (std::uint32_t j = 0; j < list.size(); ++j)
            if (list[j] == at) wanted = j;
          ASSERT_EQ(places.find(at), wanted) << at[0] << " " << at[1] << " " << at[2];
        }
}

TEST(GridPlaces, AreThoseOfTheListAlone) {
  EXPECT_EQ(GridPlaces().find({0, 0, 0}), GridPlaces::kNone);
  EXPECT_EQ(GridPlaces(std::vector<GridIndex>{}).find({0, 0, 0}), GridPlaces::kNone);
  expect_places({{0, 0, 0}});
  std::vector<GridIndex> block, row, ends;
  for (std::uint32_t x = 0; x < 5; ++x)
    for (std::uint32_t y = 0; y < 4; ++y)
      for (std::uint32_t z = 0; z < 6; z += 2) block.push_back({x, y, z});
  expect_places(block);
  for (std::uint32_t i = 0; i < 300; ++i) row.push_back({1000 + 256 * i, 7, 7});
  expect_places(row);
  for (const std::uint32_t x : {0u, 1u << 24, 0xffffffffu})
    for (const std::uint32_t y : {0u, 255u, 256u, 0xffffffffu})
      for (const std::uint32_t z : {0u, 65535u, 65536u, 0x80000000u}) ends.push_back({x, y, z});
  expect_places(ends);
}

}  // namespace
}  // namespace contactcheck
