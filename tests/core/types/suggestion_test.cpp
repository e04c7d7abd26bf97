#include "core/types/suggestion.h"

#include <gtest/gtest.h>

namespace contactcheck {
namespace {

const std::vector<std::string> kNames = {"fcl-aabb", "fcl-obbrss", "fcl-collide",
                                         "fcl-more", "embree",     "bunny-touch"};

TEST(Suggestion, IsTheNameThatTakesTheFewestEdits) {
  EXPECT_EQ(suggestion("bunny-tuch", kNames), "did you mean bunny-touch? ");
  EXPECT_EQ(suggestion("bunyn-touch", kNames), "did you mean bunny-touch? ");
  EXPECT_EQ(suggestion("embre", kNames), "did you mean embree? ");
  EXPECT_EQ(suggestion("EMBREE", kNames), "did you mean embree? ");
}

TEST(Suggestion, OfABeginningIsUpToThreeNames) {
  EXPECT_EQ(suggestion("fcl", kNames), "did you mean fcl-aabb, fcl-obbrss or fcl-collide? ");
  EXPECT_EQ(suggestion("bunny", kNames), "did you mean bunny-touch? ");
}

TEST(Suggestion, IsEmptyBeyondOneEditInThreeCharacters) {
  EXPECT_EQ(suggestion("emb", {"embree"}), "");
  EXPECT_EQ(suggestion("abcdef", {"abxyef"}), "did you mean abxyef? ");
  EXPECT_EQ(suggestion("abcdef", {"axyzef"}), "");
  EXPECT_EQ(suggestion("", {"", "a"}), "");
  EXPECT_EQ(suggestion("x", {}), "");
}

TEST(Suggestion, NamesAllThatAreEquallyNear) {
  EXPECT_EQ(suggestion("boxes", {"boxed", "boxer", "foxes", "foxer"}),
            "did you mean boxed, boxer or foxes? ");
}

}  // namespace
}  // namespace contactcheck
