#include "reference/suite/shard.h"

#include <gtest/gtest.h>

#include "core/types/check.h"

namespace contactcheck::suite {
namespace {

TEST(Shard, IsReadAsKOfN) {
  const Shard shard = parse_shard("2/3");
  EXPECT_EQ(shard.index, 2u);
  EXPECT_EQ(shard.of, 3u);
  EXPECT_EQ(shard.name(), "2/3");
  EXPECT_EQ(parse_shard("1/1").of, 1u);
  EXPECT_EQ(parse_shard("100000/100000").index, 100'000u);
}

TEST(Shard, RefusesEverythingElse) {
  for (const char* text : {"",
                           "/",
                           "1",
                           "1/",
                           "/2",
                           "0/2",
                           "3/2",
                           "-1/2",
                           "1/-2",
                           "+1/2",
                           "01/2",
                           "1/02",
                           "1.0/2",
                           "1/2/3",
                           " 1/2",
                           "1/2 ",
                           "1 /2",
                           "a/b",
                           "nan/2",
                           "1/100001",
                           "1/18446744073709551617",
                           "18446744073709551617/2",
                           "2\\3"})
    EXPECT_THROW(parse_shard(text), InputError) << text;
}

TEST(Shard, EverySceneIsInExactlyOne) {
  for (std::size_t of = 1; of <= 9; ++of) {
    for (std::size_t scene = 0; scene < 20; ++scene) {
      std::size_t holders = 0;
      for (std::size_t index = 1; index <= of; ++index) holders += Shard{index, of}.holds(scene);
      EXPECT_EQ(holders, 1u) << scene << " of " << of;
    }
  }
}

TEST(Shard, FlagGoesAndTheRestOfTheCommandStays) {
  EXPECT_EQ(without_shard_flag("contactcheck run a --shard 2/3 --out b", {2, 3}),
            "contactcheck run a --out b");
  EXPECT_EQ(without_shard_flag("contactcheck run --shard=2/3", {2, 3}), "contactcheck run");
  EXPECT_EQ(without_shard_flag("contactcheck run a", {2, 3}), "contactcheck run a");
}

}  // namespace
}  // namespace contactcheck::suite
